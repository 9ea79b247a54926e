// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "rt/threads/nonblocking.hpp"

namespace terracut::stage {

// exp and log of the standard library differ in the last bit from one machine to the next, and a
// label may hang on that bit. These two are plain IEEE arithmetic and give the same everywhere
// (docs/design.md, promise 5).

/// Natural logarithm of a finite x > 0, error below 1e-9.
[[nodiscard]] double portable_log(double x) noexcept TERRACUT_NONBLOCKING;

/// exp(-t) by a table with linear interpolation: error below 4e-5, 0 for t >= 16, 1 for t <= 0.
class NegativeExp {
 public:
  NegativeExp() noexcept;

  [[nodiscard]] float operator()(float t) const noexcept {
    // No branches: near edges and far ones come in no order.
    const bool is_inside = t < kEnd;  // and no NaN
    const float inside = (is_inside & (t > 0.0F)) ? t : 0.0F;
    const float position = inside * kStepsPerUnit;
    const auto step = static_cast<std::int32_t>(position);
    const float share = position - static_cast<float>(step);
    const float* const entry = &table_[static_cast<std::size_t>(step)];
    const float value = entry[0] + share * (entry[1] - entry[0]);
    return is_inside ? value : 0.0F;
  }

 private:
  static constexpr float kEnd = 16.0F;
  static constexpr float kStepsPerUnit = 64.0F;
  std::array<float, 16 * 64 + 2> table_;
};

}  // namespace terracut::stage
