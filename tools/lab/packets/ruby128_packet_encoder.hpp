// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/ruby128/timestamp.hpp"
#include "tools/lab/packets/labelled_return.hpp"
#include "tools/lab/packets/return_mode.hpp"

namespace terracut::packets {

/// Facts common to all data packets of one drive.
struct Ruby128PacketFacts {
  ReturnMode returns = ReturnMode::kSingle;
  ruby128::RubyTimestamp timestamp = ruby128::RubyTimestamp::kUtcMicroseconds;
  std::uint16_t protocol_version = 0;
  double temperature_deg_c = 0;  ///< In (-128, 128).
};

/// Writes three columns as one data packet: three firings, or one and a half in dual return, where
/// each return of a firing (the last, then the strongest) is a block of its own. `first_column` is
/// the first column's index in the group of firings that fill whole packets; it is even for the
/// first return of a firing. The device stamp is the first column's.
void encode_ruby128_packet(std::span<const Ruby128Column, ruby128::kRubyBlocksPerPacket> columns,
                           int first_column, const Ruby128PacketFacts& facts,
                           ruby128::ruby128_wire::Packet& packet) noexcept;

}  // namespace terracut::packets
