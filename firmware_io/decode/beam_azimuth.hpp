// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "calib/beams/angle.hpp"
#include "firmware_io/decode/packet_heads.hpp"

/// Where a beam points, in whole numbers, so that the decoder, the encoders and the truth beside a
/// capture agree on the turn and the column of every return, bit for bit. How far a beam is from
/// the azimuth its column carries is each sensor's own matter: hdl64e/firing_azimuth.hpp,
/// ruby128/firing_azimuth.hpp. Angles are in ticks (packet_heads.hpp). Allocation-free, noexcept;
/// any thread.
namespace terracut::decode {

/// Head azimuth at a firing for the geometries of calib: radians, clockwise from straight ahead,
/// [0, 2 pi + a step). `column_cdeg` may be unwrapped (any turn).
[[nodiscard]] constexpr double firing_azimuth_rad(std::int64_t column_cdeg,
                                                  std::int32_t advance_ticks) noexcept {
  return (beams::wrap_cdeg(column_cdeg) * kTicksPerCdeg + advance_ticks) * kRadPerTick;
}

/// A beam's azimuth: which turn, and where in it.
struct BeamAzimuth {
  std::int64_t turn = 0;
  std::int32_t in_turn_ticks = 0;  ///< [0, kTurn_ticks)
};

/// The beam `offset_ticks` away from a column's azimuth.
/// `column_cdeg` is unwrapped: it grows by 36000 each turn of the head. |offset| < one turn.
[[nodiscard]] constexpr BeamAzimuth beam_azimuth(std::int64_t column_cdeg,
                                                 std::int32_t offset_ticks) noexcept {
  const std::int32_t head_cdeg = beams::wrap_cdeg(column_cdeg);
  BeamAzimuth beam{(column_cdeg - head_cdeg) / beams::kTurn_cdeg,
                   head_cdeg * kTicksPerCdeg + offset_ticks};
  if (beam.in_turn_ticks < 0) {
    beam.in_turn_ticks += kTurn_ticks;
    --beam.turn;
  } else if (beam.in_turn_ticks >= kTurn_ticks) {
    beam.in_turn_ticks -= kTurn_ticks;
    ++beam.turn;
  }
  return beam;
}

/// Range image column of a beam: floor(in_turn / pitch), [0, columns). columns in [1, 36000].
[[nodiscard]] constexpr int column_of(std::int32_t in_turn_ticks, int columns) noexcept {
  return static_cast<int>(std::int64_t{in_turn_ticks} * columns / kTurn_ticks);
}

}  // namespace terracut::decode
