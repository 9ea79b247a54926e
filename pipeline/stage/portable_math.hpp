// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pipeline/stage/float_lanes.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::stage {

// exp and log of the standard library differ in the last bit between machines, and a label may
// depend on that bit. The two functions here use plain IEEE arithmetic and give the same bits
// everywhere (docs/design.md, promise 5).

/// Returns the natural logarithm of a finite x > 0, error below 1e-9.
[[nodiscard]] double portable_log(double x) noexcept TERRACUT_NONBLOCKING;

/// Computes exp(-t) by a table with linear interpolation: error below 4e-5, 0 for t >= 16, 1 for t
/// <= 0.
class NegativeExp {
 public:
  NegativeExp() noexcept;

  [[nodiscard]] FourFloats operator()(FourFloats t) const noexcept {
    const FourInts is_inside = t < kEnd;
    const FourFloats position = where(is_inside & (t > 0.0F), t) * kStepsPerUnit;
    const FourInts step = __builtin_convertvector(position, FourInts);
    const FourFloats share = position - __builtin_convertvector(step, FourFloats);
    // A single load reads an entry and the next one.
    const auto pair = [&](int lane) {
      return load_two(&table_[static_cast<std::size_t>(step[lane])]);
    };
    const FourFloats first = __builtin_shufflevector(pair(0), pair(1), 0, 1, 2, 3);
    const FourFloats second = __builtin_shufflevector(pair(2), pair(3), 0, 1, 2, 3);
    const FourFloats lower = __builtin_shufflevector(first, second, 0, 2, 4, 6);
    const FourFloats upper = __builtin_shufflevector(first, second, 1, 3, 5, 7);
    return where(is_inside, lower + share * (upper - lower));
  }

 private:
  static constexpr float kEnd = 16.0F;
  static constexpr float kStepsPerUnit = 64.0F;
  std::array<float, 16 * 64 + 2> table_;
};

}  // namespace terracut::stage
