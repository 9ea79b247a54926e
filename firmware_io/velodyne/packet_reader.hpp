// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/table/head_steps.hpp"
#include "firmware_io/velodyne/packet_layout.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::velodyne {

/// Checks the packets of one sensor and reads its head's azimuths. The checks, in this order:
///
///   kDeviceInfo         a position packet, 512 bytes
///   kWrongModel         another sensor's data packet
///   kWrongSize          not 1206 bytes
///   kWrongMagic         other block ids, or a return mode other than strongest, last and dual
///   kAzimuthOutOfRange, kAzimuthMismatch (of a firing's blocks, or of a pair in dual return)
///   kAzimuthJump, kStationary (table::HeadSteps)
///
/// `azimuths` holds stamp and azimuths for the azimuth reasons and kStationary, too. One stream,
/// one thread; real-time safe.
class PacketReader {
 public:
  /// `is_named` says that the user has named the model. A packet with an unknown product number
  /// then counts as the model's (sensor::recognise_sensor_as()), and its return mode is found from
  /// its azimuths.
  explicit PacketReader(const PacketLayout& layout, bool is_named = false) noexcept
      : layout_(layout), is_named_(is_named), steps_(layout.pace, kClockWrap_us) {}

  [[nodiscard]] sensor::SensorModel model() const noexcept { return layout_.model; }

  [[nodiscard]] std::optional<frame::Reject> read(std::span<const std::uint8_t> payload,
                                                  packet::PacketAzimuths& azimuths) noexcept
      TERRACUT_NONBLOCKING;

 private:
  [[nodiscard]] std::optional<frame::Reject> read_blocks(
      const hdl64e::wire::Packet& packet, packet::PacketAzimuths& azimuths) const noexcept;
  /// True for dual return; nothing for an unknown return mode.
  [[nodiscard]] std::optional<bool> dual_return_of(
      const hdl64e::wire::Packet& packet) const noexcept;

  PacketLayout layout_;
  bool is_named_;
  table::HeadSteps steps_;
};

}  // namespace terracut::velodyne
