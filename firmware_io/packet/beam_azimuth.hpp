// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "calib/beams/angle.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"

/// Computes azimuths of beams in whole numbers, so that the decoder, the encoders and the truth
/// beside a capture agree bit for bit on the frame and column of every return. The angle between a
/// beam and the azimuth of its column depends on the sensor: hdl64e/firing_azimuth.hpp,
/// ruby128/firing_azimuth.hpp. Angles are in ticks (packet_azimuths.hpp). Allocation-free,
/// noexcept; any thread.
namespace terracut::packet {

/// Returns the head's azimuth at a firing in the form that the geometries of calib take: radians,
/// clockwise from straight ahead, [0, 2 pi + a step). `column_cdeg` may count on over revolutions.
[[nodiscard]] constexpr double firing_azimuth_rad(std::int64_t column_cdeg,
                                                  std::int32_t advance_ticks) noexcept {
  return (beams::wrap_cdeg(column_cdeg) * kTicksPerCdeg + advance_ticks) * kRadPerTick;
}

/// How far beams point off the head: every beam's azimuth minus the head's is in [hindmost,
/// foremost].
struct BeamSpread {
  std::int64_t hindmost_ticks = 0, foremost_ticks = 0;
};

/// The azimuth of a beam: the frame it falls into, and the azimuth in that frame.
struct BeamAzimuth {
  std::int64_t frame = 0;
  std::int32_t in_revolution_ticks = 0;  ///< [0, kRevolution_ticks)
};

/// Returns the azimuth of the beam `offset_ticks` away from its column's azimuth; less than a
/// revolution. `column_cdeg` counts on over revolutions: it grows by 36000 in each.
[[nodiscard]] constexpr BeamAzimuth beam_azimuth(std::int64_t column_cdeg,
                                                 std::int32_t offset_ticks) noexcept {
  const std::int32_t rotor_cdeg = beams::wrap_cdeg(column_cdeg);
  BeamAzimuth beam{(column_cdeg - rotor_cdeg) / beams::kRevolution_cdeg,
                   rotor_cdeg * kTicksPerCdeg + offset_ticks};
  if (beam.in_revolution_ticks < 0) {
    beam.in_revolution_ticks += kRevolution_ticks;
    --beam.frame;
  } else if (beam.in_revolution_ticks >= kRevolution_ticks) {
    beam.in_revolution_ticks -= kRevolution_ticks;
    ++beam.frame;
  }
  return beam;
}

/// Returns a beam's column in the range image: floor(in_revolution_ticks / width of a column), [0,
/// columns). `columns` is in [1, 36000].
[[nodiscard]] constexpr int column_of(std::int32_t in_revolution_ticks, int columns) noexcept {
  return static_cast<int>(std::int64_t{in_revolution_ticks} * columns / kRevolution_ticks);
}

}  // namespace terracut::packet
