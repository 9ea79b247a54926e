// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "firmware_io/live/udp_sender.hpp"
#include "rt/error.hpp"
#include "rt/fixed_memory.hpp"

namespace terracut::cli {

/// Sockets to one machine: all datagrams to one port, or each to the port it was captured on, as a
/// sensor does that sends data and device information to different ones.
class PortSenders {
 public:
  /// `to`: "ADDRESS:PORT", or "ADDRESS" for every datagram's own port. `memory` must outlive this.
  /// The errors of parse_ipv4_endpoint() and UdpSender::open().
  [[nodiscard]] static Expected<PortSenders> open(const std::string& to,
                                                  firmware_io::UdpSenderConfig config,
                                                  rt::FixedMemory& memory);

  /// For a datagram captured on its way to `port`; a new port gets a new socket. Null where the
  /// system refuses one; that datagram counts as failed.
  [[nodiscard]] firmware_io::UdpSender* sender_for(std::uint16_t port);

  [[nodiscard]] firmware_io::SendCounters counters() const noexcept;
  /// "127.0.0.1:2368", or "127.0.0.1" for every datagram's own port.
  [[nodiscard]] std::string to() const;

 private:
  PortSenders(firmware_io::UdpSenderConfig config, rt::FixedMemory& memory)
      : config_(std::move(config)), memory_(&memory) {}

  firmware_io::UdpSenderConfig config_;  ///< Port 0: every datagram's own.
  rt::FixedMemory* memory_;
  std::map<std::uint16_t, firmware_io::UdpSender> by_port_;  ///< Or one for all of them, at 0.
  std::uint64_t refused_ = 0;
};

}  // namespace terracut::cli
