// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "calib/hdl64e/hdl64e_calibration.hpp"
#include "calib/ruby128/ruby128_calibration.hpp"

namespace terracut::packets {

/// One laser's measurement in one firing, with the truth about what it hit.
struct LabelledReturn {
  std::uint16_t raw = 0;       ///< Wire distance in the sensor's counts; 0 = no return.
  std::uint8_t intensity = 0;  ///< Wire intensity, uncorrected.
  std::uint32_t truth = 0;     ///< SemanticKITTI label; low 16 bits class, high 16 instance.
};

/// The returns of one firing of all lasers, by laser number on the wire. In dual return a firing
/// makes two successive columns of the same stamp and azimuth.
template <int kLasers>
struct LabelledColumn {
  std::int64_t stamp_ns = 0;  ///< Time of the first firing, nanoseconds since 1970 (UTC).
  std::int64_t unwrapped_azimuth_cdeg = 0;  ///< The head's azimuth; grows by 36000 a revolution.
  std::array<LabelledReturn, static_cast<std::size_t>(kLasers)> by_laser{};
};

/// The HDL-64E's column.
using FiringColumn = LabelledColumn<hdl64e::kHdl64eLasers>;
using Ruby128Column = LabelledColumn<ruby128::kRuby128Lasers>;

}  // namespace terracut::packets
