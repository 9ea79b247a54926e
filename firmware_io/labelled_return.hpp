// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>

#include "calib/hdl64e_calibration.hpp"

namespace terracut::firmware_io {

/// What one laser measured in one firing, with what it truly hit.
struct LabelledReturn {
  std::uint16_t raw = 0;       ///< Wire distance in counts of 2 mm; 0 = no return.
  std::uint8_t intensity = 0;  ///< Wire intensity, uncorrected.
  std::uint32_t truth = 0;     ///< SemanticKITTI label; low 16 bits class, high 16 instance.
};

/// One firing of all 64 lasers, by laser number.
struct FiringColumn {
  std::int64_t stamp_ns = 0;                ///< Of the first firing, nanoseconds since 1970 (UTC).
  std::int64_t unwrapped_azimuth_cdeg = 0;  ///< Of the head; grows by 36000 a turn.
  std::array<LabelledReturn, calib::kHdl64eLasers> by_laser{};
};

}  // namespace terracut::firmware_io
