// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "udp_sender.hpp"

#include <fmt/format.h>
#include <netinet/in.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "firmware_io/net/network_interface.hpp"

namespace terracut::send {

SendCounters& SendCounters::operator+=(const SendCounters& other) noexcept {
  sent += other.sent;
  bytes += other.bytes;
  failed += other.failed;
  if (other.last_error != 0) last_error = other.last_error;
  return *this;
}

Expected<UdpSender> UdpSender::open(const UdpSenderConfig& config, memory::FixedMemory& memory) {
  if (config.to.address == 0 || config.to.port == 0) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("cannot send to {}; expected an address and a port like 127.0.0.1:2368",
                            to_string(config.to)));
  }
  const auto refused = [](const std::string& what) {
    return fail(ErrorCode::kUnreadable, fmt::format("{}: {}", what, std::strerror(errno)));
  };
  files::OwnedDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket) return refused("UDP socket");
  const int on = 1;
  if (::setsockopt(socket.get(), SOL_SOCKET, SO_BROADCAST, &on, sizeof on) != 0) {
    return refused("SO_BROADCAST");
  }
  if (!config.interface.empty()) {
    const net::InterfaceStatus interface = net::interface_status(socket.get(), config.interface);
    if (interface.state == net::LinkState::kGone) {
      return tl::unexpected(net::no_such_interface(config.interface));
    }
    ip_mreqn multicast{};
    multicast.imr_ifindex = interface.index;
    if (::setsockopt(socket.get(), IPPROTO_IP, IP_MULTICAST_IF, &multicast, sizeof multicast) !=
            0 ||
        ::setsockopt(socket.get(), SOL_SOCKET, SO_BINDTODEVICE, config.interface.c_str(),
                     static_cast<socklen_t>(config.interface.size() + 1)) != 0) {
      return refused(fmt::format("interface '{}'", config.interface));
    }
  }
  if (config.from) {
    const sockaddr_in from = socket_address(*config.from);
    if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&from), sizeof from) != 0) {
      const ErrorCode code = errno == EADDRNOTAVAIL ? ErrorCode::kNotFound : ErrorCode::kUnreadable;
      return fail(code, fmt::format("cannot send from {}: {}; expected a free port of an address "
                                    "that `ip -4 addr` lists",
                                    to_string(*config.from), std::strerror(errno)));
    }
  }
  return UdpSender(std::move(socket), config.to, memory);
}

UdpSender::UdpSender(files::OwnedDescriptor socket, const net::Ipv4Endpoint& to,
                     memory::FixedMemory& memory)
    : socket_(std::move(socket)),
      to_(to),
      address_(memory.take<::sockaddr_in>("udp sender", 1)),
      messages_(memory.take<::mmsghdr>("udp sender", kBatch)),
      vectors_(memory.take<::iovec>("udp sender", kBatch)) {
  address_[0] = socket_address(to);
  for (std::size_t slot = 0; slot < kBatch; ++slot) {
    ::msghdr& header = messages_[slot].msg_hdr;
    header.msg_name = address_.data();
    header.msg_namelen = sizeof(sockaddr_in);
    header.msg_iov = &vectors_[slot];
    header.msg_iovlen = 1;
  }
}

std::size_t UdpSender::send(std::span<const packet::Datagram> datagrams) noexcept {
  std::size_t sent_now = 0;
  while (!datagrams.empty()) {
    const std::size_t count = std::min(datagrams.size(), kBatch);
    for (std::size_t slot = 0; slot < count; ++slot) {
      const auto payload = datagrams[slot].payload;
      // The cast is safe: sendmmsg() only reads the bytes, but iovec has no const pointer.
      vectors_[slot] = {const_cast<std::uint8_t*>(payload.data()), payload.size()};
    }
    // Stops at the first datagram that fails; the next call returns its error.
    const int accepted =
        ::sendmmsg(socket_.get(), messages_.data(), static_cast<unsigned>(count), 0);
    if (accepted < 0) {
      if (errno == EINTR) continue;
      counters_.last_error = errno;
      ++counters_.failed;
      datagrams = datagrams.subspan(1);
      continue;
    }
    const auto done = static_cast<std::size_t>(accepted);
    for (const packet::Datagram& each : datagrams.first(done))
      counters_.bytes += each.payload.size();
    counters_.sent += done;
    sent_now += done;
    datagrams = datagrams.subspan(done);
  }
  return sent_now;
}

}  // namespace terracut::send
