// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "calib/beams/angle.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::packet {

struct SinCos {
  float sin = 0, cos = 1;
};

/// A table of the sine and cosine of every azimuth that can be sent, 36000 steps of 0.01 degrees.
/// It is computed in double at start, so that the packet path needs no library function and every
/// machine gets the same bits.
class RotorDirections {
 public:
  explicit RotorDirections(memory::FixedMemory& memory)
      : table_(memory.take<SinCos>("decoder tables", beams::kRevolution_cdeg)) {
    for (std::size_t i = 0; i < table_.size(); ++i) {
      const double azimuth_rad = beams::deg_to_rad(static_cast<double>(i) / 100.0);
      table_[i] = {static_cast<float>(std::sin(azimuth_rad)),
                   static_cast<float>(std::cos(azimuth_rad))};
    }
  }

  /// Looks up `azimuth_cdeg` in [0, 36000). Real-time safe.
  [[nodiscard]] SinCos at(std::int32_t azimuth_cdeg) const noexcept {
    return table_[static_cast<std::size_t>(azimuth_cdeg)];
  }

 private:
  std::span<SinCos> table_;
};

}  // namespace terracut::packet
