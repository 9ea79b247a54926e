// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <sys/socket.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::send {

struct UdpSenderConfig {
  net::Ipv4Endpoint to{};  ///< An address, a broadcast address or a multicast group.
  std::optional<net::Ipv4Endpoint> from{};  ///< Source; none: chosen by the system.
  std::string interface{};  ///< Interface for multicast and broadcast; empty: by routing.
};

/// Counts of datagrams; `failed` ones were refused by the system (no route, interface down).
struct SendCounters {
  std::uint64_t sent = 0;
  std::uint64_t bytes = 0;  ///< Bytes of the payloads sent.
  std::uint64_t failed = 0;
  int last_error = 0;  ///< errno of the newest failure.

  /// Adds the counters of another sender; `last_error` is then that of one of the two.
  SendCounters& operator+=(const SendCounters& other) noexcept;
};

/// Sends datagrams as a sensor would, whether or not anybody listens. One thread.
class UdpSender {
 public:
  static constexpr std::size_t kBatch = 64;

  /// Takes all its memory. Fails with kInvalidArgument if the address or the port to send to is
  /// missing; kNotFound if `from` is no address of this machine, or there is no such interface;
  /// kUnreadable if the system refuses for another reason.
  [[nodiscard]] static Expected<UdpSender> open(const UdpSenderConfig& config,
                                                memory::FixedMemory& memory);

  /// Sends the payloads in order, kBatch per system call; the datagrams' stamps and addresses are
  /// ignored. Waits while the system's send buffer is full. Returns the number sent; the others are
  /// counted as failed.
  std::size_t send(std::span<const packet::Datagram> datagrams) noexcept;

  [[nodiscard]] const SendCounters& counters() const noexcept { return counters_; }
  [[nodiscard]] const net::Ipv4Endpoint& to() const noexcept { return to_; }

 private:
  UdpSender(files::OwnedDescriptor socket, const net::Ipv4Endpoint& to,
            memory::FixedMemory& memory);

  files::OwnedDescriptor socket_;
  net::Ipv4Endpoint to_;
  std::span<::sockaddr_in> address_;  ///< One element: the destination.
  std::span<::mmsghdr> messages_;
  std::span<::iovec> vectors_;
  SendCounters counters_;
};

}  // namespace terracut::send
