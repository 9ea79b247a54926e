// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/elevation/lone_returns.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "rt/vector_clones.hpp"

namespace terracut::elevation {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// The columns to compare with, by offset: 0, or NaN where a column belongs to another sector.
struct Apart {
  const float *left_2, *left_1, *right_1, *right_2;
};

/// Compares `count` returns with those beside them; `z_m` begins two columns before the first. Has
/// no branches, so that the compiler vectorises it; comparisons with NaN are false.
TERRACUT_VECTOR_CLONES void take_out_inner(const float* __restrict z_m, const Apart apart,
                                           float depth_m, std::size_t count,
                                           float* __restrict kept_m) noexcept {
  const float near_m = depth_m / 2;
  for (std::size_t i = 0; i < count; ++i) {
    const float here_m = z_m[i + 2];
    float most_above_m = 0, nearest_m = depth_m;
    const auto compare = [&](float other_m, float apart_m) __attribute__((always_inline)) {
      const float above_m = other_m - here_m + apart_m;
      const float away_m = std::fabs(above_m);
      most_above_m = above_m > most_above_m ? above_m : most_above_m;
      nearest_m = away_m < nearest_m ? away_m : nearest_m;
    };
    compare(z_m[i], apart.left_2[i]);
    compare(z_m[i + 1], apart.left_1[i]);
    compare(z_m[i + 3], apart.right_1[i]);
    compare(z_m[i + 4], apart.right_2[i]);
    const float alone_m = nearest_m < near_m ? here_m : kNone;
    kept_m[i] = most_above_m > depth_m ? alone_m : here_m;
  }
}

}  // namespace

LoneReturns::LoneReturns(float depth_m, const RingGrid& grid, frame::ImageShape shape,
                         memory::FixedMemory& memory)
    : depth_m_(depth_m) {
  for (std::size_t i = 0; i < std::size(kOffsets); ++i) {
    std::span<float>& apart = apart_[i];
    apart = memory.take<float>("lone returns", static_cast<std::size_t>(shape.columns));
    for (int column = 0; column < shape.columns; ++column) {
      const int other = column + kOffsets[i];
      const bool is_beside =
          other >= 0 && other < shape.columns && grid.sector_of(other) == grid.sector_of(column);
      apart[static_cast<std::size_t>(column)] = is_beside ? 0.0F : kNone;
    }
  }
}

void LoneReturns::take_out(const float* z_m, frame::ColumnRange columns,
                           std::span<float> kept_m) const noexcept {
  // What lies beyond `columns` may not be read, so pieces are compared in a copy with a margin.
  constexpr int kPiece = 512;
  float copy_m[kReach + kPiece + kReach];
  for (int begin = columns.begin; begin < columns.end; begin += kPiece) {
    const int end = std::min(begin + kPiece, columns.end);
    const int first = std::max(begin - kReach, columns.begin);
    const int last = std::min(end + kReach, columns.end);
    std::fill_n(copy_m, kReach, kNone);
    std::copy(z_m + first, z_m + last, copy_m + kReach - (begin - first));
    std::fill_n(copy_m + kReach + (last - begin), kReach - (last - end), kNone);
    const auto at = static_cast<std::size_t>(begin);
    take_out_inner(copy_m, {&apart_[0][at], &apart_[1][at], &apart_[2][at], &apart_[3][at]},
                   depth_m_, static_cast<std::size_t>(end - begin),
                   kept_m.data() + (begin - columns.begin));
  }
}

}  // namespace terracut::elevation
