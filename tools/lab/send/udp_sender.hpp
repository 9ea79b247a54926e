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
  net::Ipv4Endpoint to{};  ///< One address, a broadcast address or a multicast group.
  std::optional<net::Ipv4Endpoint> from{};  ///< Sent from here; else the system chooses.
  std::string interface{};                  ///< Of multicast and broadcast; empty: by the routes.
};

/// failed datagrams were not sent: the system refused them (no route, interface down).
struct SendCounters {
  std::uint64_t sent = 0;
  std::uint64_t bytes = 0;  ///< Payload.
  std::uint64_t failed = 0;
  int last_error = 0;  ///< errno of the newest failure.

  /// Of several senders; `last_error` is of one that has any.
  SendCounters& operator+=(const SendCounters& other) noexcept;
};

/// Sends datagrams as a sensor would: whether anybody listens makes no difference. One thread.
class UdpSender {
 public:
  static constexpr std::size_t kBatch = 64;

  /// kInvalidArgument: no address or port to send to. kNotFound: `from` is none of this machine's
  /// addresses, or there is no such interface. kUnreadable: another refusal of the system. Memory
  /// is taken here, none later.
  [[nodiscard]] static Expected<UdpSender> open(const UdpSenderConfig& config,
                                                memory::FixedMemory& memory);

  /// Sends the payloads in this order, kBatch to a system call; stamps and addresses of the
  /// datagrams do not matter. Waits while the system's send buffer is full; returns how many were
  /// sent, the others are counted as failed.
  std::size_t send(std::span<const packet::Datagram> datagrams) noexcept;

  [[nodiscard]] const SendCounters& counters() const noexcept { return counters_; }
  [[nodiscard]] const net::Ipv4Endpoint& to() const noexcept { return to_; }

 private:
  UdpSender(files::OwnedDescriptor socket, const net::Ipv4Endpoint& to,
            memory::FixedMemory& memory);

  files::OwnedDescriptor socket_;
  net::Ipv4Endpoint to_;
  std::span<::sockaddr_in> address_;  ///< One: where all go.
  std::span<::mmsghdr> messages_;
  std::span<::iovec> vectors_;
  SendCounters counters_;
};

}  // namespace terracut::send
