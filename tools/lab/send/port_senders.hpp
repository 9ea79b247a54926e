// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "rt/error.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "udp_sender.hpp"

namespace terracut::send {

/// Sockets that send to one machine: all datagrams to one port, or each to the port that it had in
/// the capture, as a sensor sends data and device information to different ports.
class PortSenders {
 public:
  /// `to` is "ADDRESS:PORT" or, for each datagram's own port, "ADDRESS". `memory` must outlive this
  /// object. Fails with the errors of parse_ipv4_endpoint() and UdpSender::open().
  [[nodiscard]] static Expected<PortSenders> open(const std::string& to, UdpSenderConfig config,
                                                  memory::FixedMemory& memory);

  /// Returns the sender for a datagram that was captured on its way to `port`; a new port gets a
  /// new socket. Null if the system refuses one; that datagram counts as failed.
  [[nodiscard]] UdpSender* sender_for(std::uint16_t port);

  [[nodiscard]] SendCounters counters() const noexcept;
  /// Returns "127.0.0.1:2368", or "127.0.0.1" for each datagram's own port.
  [[nodiscard]] std::string to() const;

 private:
  PortSenders(UdpSenderConfig config, memory::FixedMemory& memory)
      : config_(std::move(config)), memory_(&memory) {}

  UdpSenderConfig config_;  ///< Port 0: each datagram's own.
  memory::FixedMemory* memory_;
  std::map<std::uint16_t, UdpSender> by_port_;  ///< One sender for all ports has key 0.
  std::uint64_t refused_ = 0;
};

}  // namespace terracut::send
