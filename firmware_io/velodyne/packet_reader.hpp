// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
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
///   kAzimuthJump        steps beyond those of packet_layout.hpp. A packet begun before the head
///                       left a limited field of view continues when it is back: one such step
///                       is accepted (PacketAzimuths::behind_sector) once the rate is known; the
///                       caller must know whether there is such a sector
///   kStationary
///
/// `azimuths` holds stamp and azimuths for the azimuth reasons and kStationary, too. One stream,
/// one thread; real-time safe.
class PacketReader {
 public:
  /// `is_named` says that the user has named the model. A packet with an unknown product number
  /// then counts as the model's (sensor::recognise_sensor_as()), and its return mode is found from
  /// its azimuths.
  explicit PacketReader(const PacketLayout& layout, bool is_named = false) noexcept
      : layout_(layout), is_named_(is_named) {}

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
  [[nodiscard]] std::optional<frame::Reject> judge_steps(packet::PacketAzimuths& azimuths) noexcept;
  [[nodiscard]] std::int32_t step_of(const packet::PacketAzimuths& azimuths,
                                     std::int32_t advance_cdeg) noexcept;
  void complete(packet::PacketAzimuths& azimuths) const noexcept;

  PacketLayout layout_;
  bool is_named_;
  std::int32_t step_ticks_ = 0;  ///< Step of the last packet that had one; 0: none yet.
  bool is_step_guessed_ = false;
  struct {
    std::int64_t stamp_us = 0;
    std::int32_t azimuth_cdeg = 0;
    bool is_known = false;
  } last_;  ///< The packet before.
};

}  // namespace terracut::velodyne
