// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/elevation/lone_returns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rt/vector_clones.hpp"

namespace terracut::elevation {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// The columns to compare with, by offset: 0, or NaN where a column belongs to another sector.
struct Apart {
  const float *left_2, *left_1, *right_1, *right_2;
};

/// Compares `count` returns with those beside them. Has no branches, so that the compiler
/// vectorises it; comparisons with NaN are false.
TERRACUT_VECTOR_CLONES void take_out_inner(const float* __restrict z_m, const Apart apart,
                                           float depth_m, std::size_t count,
                                           float* __restrict kept_m) noexcept {
  const float near_m = depth_m / 2;
  const auto is_more = [](float a, float b) { return a > b ? 1 : 0; };
  for (std::size_t i = 0; i < count; ++i) {
    const float here_m = z_m[i];
    const float above_a = z_m[i - 2] - here_m + apart.left_2[i];
    const float above_b = z_m[i - 1] - here_m + apart.left_1[i];
    const float above_c = z_m[i + 1] - here_m + apart.right_1[i];
    const float above_d = z_m[i + 2] - here_m + apart.right_2[i];
    const int is_below = is_more(above_a, depth_m) | is_more(above_b, depth_m) |
                         is_more(above_c, depth_m) | is_more(above_d, depth_m);
    const int has_company =
        is_more(near_m, std::fabs(above_a)) | is_more(near_m, std::fabs(above_b)) |
        is_more(near_m, std::fabs(above_c)) | is_more(near_m, std::fabs(above_d));
    const int is_lone = is_below & (1 - has_company);
    kept_m[i] = is_lone != 0 ? kNone : here_m;
  }
}

}  // namespace

LoneReturns::LoneReturns(float depth_m, const RingGrid& grid, frame::ImageShape shape,
                         memory::FixedMemory& memory)
    : depth_m_(depth_m) {
  for (int offset = -kReach; offset <= kReach; ++offset) {
    std::span<float>& apart = apart_[offset + kReach];
    apart = memory.take<float>("lone returns", static_cast<std::size_t>(shape.columns));
    for (int column = 0; column < shape.columns; ++column) {
      const int other = column + offset;
      const bool is_beside =
          other >= 0 && other < shape.columns && grid.sector_of(other) == grid.sector_of(column);
      apart[static_cast<std::size_t>(column)] = is_beside ? 0.0F : kNone;
    }
  }
}

void LoneReturns::take_out(const float* z_m, frame::ColumnRange columns,
                           std::span<float> kept_m) const noexcept {
  // The outermost columns are compared by themselves: what lies beyond may not be read.
  const auto compare_alone = [&](int column) {
    float beside[2 * kReach + 1];
    const float same[1] = {0.0F};
    for (int offset = -kReach; offset <= kReach; ++offset) {
      const int other = column + offset;
      const bool is_known = other >= columns.begin && other < columns.end;
      const float apart = apart_[offset + kReach][static_cast<std::size_t>(column)];
      beside[offset + kReach] = is_known && apart == 0.0F ? z_m[other] : kNone;
    }
    take_out_inner(&beside[kReach], {same, same, same, same}, depth_m_, 1,
                   &kept_m[static_cast<std::size_t>(column - columns.begin)]);
  };
  const int inner_begin = std::min(columns.begin + kReach, columns.end);
  const int inner_end = std::max(columns.end - kReach, inner_begin);
  for (int column = columns.begin; column < inner_begin; ++column) compare_alone(column);
  const auto first = static_cast<std::size_t>(inner_begin);
  take_out_inner(z_m + first,
                 {&apart_[0][first], &apart_[1][first], &apart_[3][first], &apart_[4][first]},
                 depth_m_, static_cast<std::size_t>(inner_end - inner_begin),
                 kept_m.data() + (inner_begin - columns.begin));
  for (int column = inner_end; column < columns.end; ++column) compare_alone(column);
}

}  // namespace terracut::elevation
