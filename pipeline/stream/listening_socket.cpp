// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stream/listening_socket.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace terracut::stream {
namespace {

constexpr int kBacklog = 16;

tl::unexpected<Error> refused(const StreamAddress& address) {
  const int reason = errno;
  const bool absent = reason == EADDRNOTAVAIL || reason == ENOENT || reason == ENOTDIR;
  std::string advice = "choose another address";
  if (reason == EADDRINUSE) advice = "another program has it; choose another port";
  if (reason == EADDRNOTAVAIL) advice = "expected an address that `ip -4 addr` lists";
  if (reason == EACCES) advice = "choose a port from 1024 on, or a folder that may be written to";
  if (reason == ENOENT || reason == ENOTDIR) advice = "its folder has to be there";
  return fail(absent ? ErrorCode::kNotFound : ErrorCode::kUnreadable,
              fmt::format("cannot serve labelled frames on {}: {}; {}", to_string(address),
                          std::strerror(reason), advice));
}

/// True if the path is a Unix socket that no process listens to any more.
Expected<bool> left_behind(const StreamAddress& address) {
  struct ::stat status{};
  if (::lstat(address.unix_path.c_str(), &status) != 0) {
    if (errno == ENOENT) return false;
    return refused(address);
  }
  if (!S_ISSOCK(status.st_mode)) {
    return fail(
        ErrorCode::kUnreadable,
        fmt::format("cannot serve labelled frames on {}: there is a file that is no socket; "
                    "choose another path",
                    address.unix_path));
  }
  const files::OwnedDescriptor probe(
      ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const SocketAddress local = socket_address(address);
  const bool answered = ::connect(probe.get(), local.get(), local.size) == 0 || errno == EAGAIN;
  if (answered) {
    errno = EADDRINUSE;
    return fail(ErrorCode::kUnreadable,
                fmt::format("cannot serve labelled frames on {}: another program listens there; "
                            "choose another path",
                            address.unix_path));
  }
  if (errno != ECONNREFUSED) return refused(address);
  return true;
}

}  // namespace

Expected<ListeningSocket> ListeningSocket::open(const StreamAddress& address, ::mode_t unix_mode) {
  if (address.is_unix()) {
    const auto stale = left_behind(address);
    if (!stale) return tl::unexpected(stale.error());
    if (*stale && ::unlink(address.unix_path.c_str()) != 0) return refused(address);
  }
  const int family = address.is_unix() ? AF_UNIX : AF_INET;
  files::OwnedDescriptor descriptor(
      ::socket(family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!descriptor) return refused(address);
  if (!address.is_unix()) {
    // Connections of an earlier run that the system still remembers do not block the address then.
    const int on = 1;
    ::setsockopt(descriptor.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  }
  const SocketAddress wanted = socket_address(address);
  if (::bind(descriptor.get(), wanted.get(), wanted.size) != 0) return refused(address);
  ListeningSocket listening(std::move(descriptor), address);
  if (address.is_unix()) {
    struct ::stat status{};
    // Nobody can connect before the rights are set, because the socket does not listen yet.
    if (::lstat(address.unix_path.c_str(), &status) != 0 ||
        ::chmod(address.unix_path.c_str(), unix_mode) != 0) {
      return refused(address);
    }
    listening.device_ = status.st_dev;
    listening.inode_ = status.st_ino;
  } else {
    ::sockaddr_in bound{};
    ::socklen_t size = sizeof bound;
    if (::getsockname(listening.descriptor(), reinterpret_cast<::sockaddr*>(&bound), &size) != 0) {
      return refused(address);
    }
    listening.address_.tcp = net::endpoint_of(bound);
  }
  if (::listen(listening.descriptor(), kBacklog) != 0) return refused(address);
  return listening;
}

ListeningSocket::ListeningSocket(ListeningSocket&& other) noexcept
    : socket_(std::move(other.socket_)),
      address_(std::exchange(other.address_, {})),
      device_(other.device_),
      inode_(std::exchange(other.inode_, 0)) {}

ListeningSocket& ListeningSocket::operator=(ListeningSocket&& other) noexcept {
  if (this != &other) {
    close();
    socket_ = std::move(other.socket_);
    address_ = std::exchange(other.address_, {});
    device_ = other.device_;
    inode_ = std::exchange(other.inode_, 0);
  }
  return *this;
}

void ListeningSocket::close() noexcept {
  socket_.close();
  if (inode_ == 0) return;
  struct ::stat status{};
  const bool still_ours = ::lstat(address_.unix_path.c_str(), &status) == 0 &&
                          status.st_dev == device_ && status.st_ino == inode_;
  if (still_ours) ::unlink(address_.unix_path.c_str());
  inode_ = 0;
}

}  // namespace terracut::stream
