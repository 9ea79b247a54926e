// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>

#include "rt/nonblocking.hpp"

namespace terracut::pipeline {

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
    if (!(t < kEnd)) return 0.0F;
    if (t <= 0.0F) return 1.0F;
    const float position = t * kStepsPerUnit;
    const auto step = static_cast<std::size_t>(position);
    const float share = position - static_cast<float>(step);
    return table_[step] + share * (table_[step + 1] - table_[step]);
  }

 private:
  static constexpr float kEnd = 16.0F;
  static constexpr float kStepsPerUnit = 64.0F;
  std::array<float, 16 * 64 + 2> table_;
};

}  // namespace terracut::pipeline
