// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "service_notify.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include "rt/number_of.hpp"

namespace terracut::cli {
namespace {

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view{} : std::string_view{value};
}

std::optional<std::int64_t> number_in(const char* name) {
  return rt::number_of<std::int64_t>(environment(name));
}

std::optional<std::int64_t> watchdog_of_environment() {
  const std::optional<std::int64_t> time_us = number_in("WATCHDOG_USEC");
  if (!time_us || *time_us <= 0 || *time_us > INT64_MAX / 1000) return std::nullopt;
  // WATCHDOG_PID names the only process that systemd watches; child processes inherit the
  // variables, too.
  if (!environment("WATCHDOG_PID").empty() && number_in("WATCHDOG_PID") != ::getpid()) {
    return std::nullopt;
  }
  return *time_us * 1000;
}

/// The text "STATUS=..." as the protocol requires it: on one line. A long text is cut.
struct StatusLine {
  static constexpr std::string_view kKey = "STATUS=";
  static constexpr std::size_t kMost = 200;

  char bytes[32 + kMost] = {};
  std::size_t size = 0;

  StatusLine(std::string_view before, std::string_view status) noexcept {
    for (const std::string_view part : {before, kKey, status.substr(0, kMost)}) {
      std::memcpy(bytes + size, part.data(), part.size());
      size += part.size();
    }
    for (std::size_t i = before.size(); i < size; ++i) {
      if (bytes[i] == '\n') bytes[i] = ' ';
    }
  }
  [[nodiscard]] std::string_view text() const noexcept { return {bytes, size}; }
};

}  // namespace

Expected<ServiceNotify> ServiceNotify::from_environment() {
  ServiceNotify notify;
  const std::string_view name = environment("NOTIFY_SOCKET");
  if (name.empty()) return notify;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if ((name.front() != '/' && name.front() != '@') || name.size() >= sizeof address.sun_path) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("NOTIFY_SOCKET: expected a path or @name of at most {} bytes, found "
                            "'{}'",
                            sizeof address.sun_path - 1, name));
  }
  std::memcpy(address.sun_path, name.data(), name.size());
  const bool abstract = name.front() == '@';
  if (abstract) address.sun_path[0] = '\0';
  // The length of a path includes its terminating zero; that of an abstract name does not.
  const auto length =
      static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size() + (abstract ? 0 : 1));
  files::OwnedDescriptor socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket ||
      ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), length) != 0) {
    return fail(ErrorCode::kNotFound, fmt::format("NOTIFY_SOCKET '{}' cannot be reached: {}", name,
                                                  std::generic_category().message(errno)));
  }
  notify.socket_ = std::move(socket);
  notify.watchdog_ns_ = watchdog_of_environment();
  return notify;
}

bool ServiceNotify::send(std::string_view message) const noexcept {
  return connected() && ::send(socket_.get(), message.data(), message.size(), MSG_NOSIGNAL) ==
                            static_cast<ssize_t>(message.size());
}

bool ServiceNotify::ready(std::string_view status) const noexcept {
  return send(StatusLine("READY=1\n", status).text());
}
bool ServiceNotify::status(std::string_view status) const noexcept {
  return send(StatusLine("", status).text());
}
bool ServiceNotify::feed_watchdog() const noexcept {
  return send("WATCHDOG=1");
}
bool ServiceNotify::stopping() const noexcept {
  return send("STOPPING=1");
}

}  // namespace terracut::cli
