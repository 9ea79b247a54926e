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

/// Sockets to one machine: all datagrams to one port, or each to the port it was captured on, as a
/// sensor does that sends data and device information to different ones.
class PortSenders {
 public:
  /// `to`: "ADDRESS:PORT", or "ADDRESS" for every datagram's own port. `memory` must outlive this.
  /// The errors of parse_ipv4_endpoint() and UdpSender::open().
  [[nodiscard]] static Expected<PortSenders> open(const std::string& to, UdpSenderConfig config,
                                                  memory::FixedMemory& memory);

  /// For a datagram captured on its way to `port`; a new port gets a new socket. Null where the
  /// system refuses one; that datagram counts as failed.
  [[nodiscard]] UdpSender* sender_for(std::uint16_t port);

  [[nodiscard]] SendCounters counters() const noexcept;
  /// "127.0.0.1:2368", or "127.0.0.1" for every datagram's own port.
  [[nodiscard]] std::string to() const;

 private:
  PortSenders(UdpSenderConfig config, memory::FixedMemory& memory)
      : config_(std::move(config)), memory_(&memory) {}

  UdpSenderConfig config_;  ///< Port 0: every datagram's own.
  memory::FixedMemory* memory_;
  std::map<std::uint16_t, UdpSender> by_port_;  ///< Or one for all of them, at 0.
  std::uint64_t refused_ = 0;
};

}  // namespace terracut::send
