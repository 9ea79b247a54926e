// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/packet/robosense_wire.hpp"
#include "firmware_io/ruby128/timestamp.hpp"
#include "firmware_io/table/head_steps.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::robosense {

/// Device stamps count from 1970 and never wrap: this is larger than all of them.
inline constexpr std::int64_t kClockWrap_us = std::int64_t{1} << 56;

/// A block is a column, and in dual return two are.
[[nodiscard]] constexpr table::ColumnPace pace_of(const PacketLayout& layout) noexcept {
  return {layout.column_ns, kBlocks, kBlocks / 2};
}

/// Checks the packets of one sensor and reads its head's azimuths. Packets do not state the return
/// mode: they are dual if each of their azimuths comes twice. The checks, in this order:
///
///   kWrongModel, kDeviceInfo   another sensor's data packet; a DIFOP packet
///   kWrongSize, kWrongMagic    another size, header or block id
///   kAzimuthOutOfRange
///   kAzimuthJump, kStationary  (table::HeadSteps)
///
/// `azimuths` holds stamp and azimuths for the azimuth reasons and kStationary, too. One stream,
/// one thread; real-time safe.
class PacketReader {
 public:
  /// `timestamp` is the stamps' encoding; empty: found out from the packets.
  explicit PacketReader(const PacketLayout& layout,
                        std::optional<ruby128::RubyTimestamp> timestamp = {}) noexcept
      : layout_(layout), clock_(timestamp), steps_(pace_of(layout), kClockWrap_us) {}

  [[nodiscard]] sensor::SensorModel model() const noexcept { return layout_.model; }

  [[nodiscard]] std::optional<frame::Reject> read(std::span<const std::uint8_t> payload,
                                                  packet::PacketAzimuths& azimuths) noexcept
      TERRACUT_NONBLOCKING;

 private:
  PacketLayout layout_;
  ruby128::RubyClock clock_;
  table::HeadSteps steps_;
};

}  // namespace terracut::robosense
