// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/packet/hesai_wire.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/table/head_steps.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::hesai {

/// Device stamps count from year 0 of the packets' calendar and never wrap: this is larger than
/// all.
inline constexpr std::int64_t kClockWrap_us = std::int64_t{1} << 56;

/// A block is a column, and in dual return two are.
[[nodiscard]] constexpr table::ColumnPace pace_of(const PacketLayout& layout) noexcept {
  return {layout.column_ns, layout.blocks, layout.blocks / 2};
}

/// Checks the packets of one sensor and reads its head's azimuths. The checks, in this order:
///
///   kWrongModel         another sensor's data packet
///   kWrongSize          no size of the model's
///   kWrongMagic         another start, other numbers of lasers and blocks, another unit of
///                       distances, or a return mode that is neither single nor dual
///   kAzimuthOutOfRange, kAzimuthMismatch (of a pair in dual return)
///   kAzimuthJump, kStationary (table::HeadSteps)
///
/// `azimuths` holds stamp and azimuths for the azimuth reasons and kStationary, too. One stream,
/// one thread; real-time safe.
class PacketReader {
 public:
  explicit PacketReader(const PacketLayout& layout) noexcept
      : layout_(layout), steps_(pace_of(layout), kClockWrap_us) {}

  [[nodiscard]] sensor::SensorModel model() const noexcept { return layout_.model; }

  [[nodiscard]] std::optional<frame::Reject> read(std::span<const std::uint8_t> payload,
                                                  packet::PacketAzimuths& azimuths) noexcept
      TERRACUT_NONBLOCKING;

 private:
  PacketLayout layout_;
  table::HeadSteps steps_;
};

}  // namespace terracut::hesai
