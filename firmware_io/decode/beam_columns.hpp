// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware_io/decode/column_returns.hpp"
#include "firmware_io/decode/packet_azimuths.hpp"

namespace terracut::decode {

/// beam_azimuth() and column_of() (beam_azimuth.hpp) for all beams of a firing at once, in a loop
/// that compilers vectorise.
class BeamColumns {
 public:
  explicit BeamColumns(int columns)
      : columns_per_tick_(static_cast<double>(columns) / kRevolution_ticks) {}

  /// Writes `out.column` and `out.frame_offset`. `offset_ticks`: beam minus head, of each laser.
  template <std::size_t kLasers>
  void compute(std::int32_t azimuth_cdeg, const std::array<std::int32_t, kLasers>& offset_ticks,
               ColumnReturns<kLasers>& out) const noexcept {
    // Half a tick's worth of column keeps the product on the right side of every whole number, so
    // that this is exactly column_of(): the distance to the next is at least twice that, the
    // rounding of the product a thousand times less.
    const double scale = columns_per_tick_;
    const double bias = 0.5 / kRevolution_ticks;
    const std::int32_t rotor_ticks = azimuth_cdeg * kTicksPerCdeg;
    for (std::size_t i = 0; i < kLasers; ++i) {
      const std::int32_t beam_ticks = rotor_ticks + offset_ticks[i];
      const std::int32_t frame = static_cast<std::int32_t>(beam_ticks >= kRevolution_ticks) -
                                 static_cast<std::int32_t>(beam_ticks < 0);
      const std::int32_t in_revolution_ticks = beam_ticks - frame * kRevolution_ticks;
      out.frame_offset[i] = frame;
      out.column[i] =
          static_cast<std::int32_t>(static_cast<double>(in_revolution_ticks) * scale + bias);
    }
  }

 private:
  double columns_per_tick_;
};

}  // namespace terracut::decode
