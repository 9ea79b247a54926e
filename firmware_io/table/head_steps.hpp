// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>

#include "firmware_io/frame/loss_counters.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/table/column_pace.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::table {

/// Judges the steps between the head's azimuths in the packets of one sensor, and completes what
/// follows from them. One stream, one thread; real-time safe.
class HeadSteps {
 public:
  /// The device's clock counts [0, clock_wrap_us).
  HeadSteps(const ColumnPace& pace, std::int64_t clock_wrap_us) noexcept
      : pace_(pace), clock_wrap_us_(clock_wrap_us) {}

  /// Takes the azimuths, stamp and return mode of the next packet, whose azimuths are in range, and
  /// fills in the rest. Rejects it with kAzimuthJump or kStationary. A packet begun before the head
  /// left a limited field of view continues when it is back: one such step is accepted
  /// (packet::PacketAzimuths::behind_sector) once the rate is known; the caller must know whether
  /// there is such a sector.
  [[nodiscard]] std::optional<frame::Reject> judge(packet::PacketAzimuths& azimuths) noexcept
      TERRACUT_NONBLOCKING;

 private:
  [[nodiscard]] std::optional<frame::Reject> judge_steps(packet::PacketAzimuths& azimuths) noexcept;
  [[nodiscard]] std::int32_t step_of(const packet::PacketAzimuths& azimuths,
                                     std::int32_t advance_cdeg) noexcept;
  void complete(packet::PacketAzimuths& azimuths) const noexcept;

  ColumnPace pace_;
  std::int64_t clock_wrap_us_;
  std::int32_t step_ticks_ = 0;  ///< Step of the last packet that had one; 0: none yet.
  bool is_step_guessed_ = false;
  struct {
    std::int64_t stamp_us = 0;
    std::int32_t azimuth_cdeg = 0;
    bool is_known = false;
  } last_;  ///< The packet before.
};

}  // namespace terracut::table
