// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "returns_by_place.hpp"

#include <algorithm>
#include <cmath>

namespace terracut::hazards {
namespace {

int square_of(double metres, int farthest_m) noexcept {
  return static_cast<int>(std::floor(metres)) + farthest_m;
}

}  // namespace

ReturnsByPlace::ReturnsByPlace(const LabelledFrame& frame)
    : frame_(frame), first_(static_cast<std::size_t>(kSide * kSide) + 1) {
  const auto for_each = [&](auto&& take) {
    for (std::uint32_t i = 0; i < frame.size(); ++i) {
      if (!(frame.at[i].head<2>().cwiseAbs().maxCoeff() < kFarthest_m)) continue;
      const int column = square_of(frame.at[i].x(), kFarthest_m);
      const int row = square_of(frame.at[i].y(), kFarthest_m);
      take(static_cast<std::size_t>(row * kSide + column), i);
    }
  };
  for_each([&](std::size_t square, std::uint32_t) { ++first_[square + 1]; });
  for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  indices_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for_each([&](std::size_t square, std::uint32_t i) { indices_[next[square]++] = i; });
}

ReturnsByPlace::Bounds ReturnsByPlace::bounds(double middle_m, double radius_m) noexcept {
  return {std::clamp(square_of(middle_m - radius_m, kFarthest_m), 0, kSide - 1),
          std::clamp(square_of(middle_m + radius_m, kFarthest_m), 0, kSide - 1)};
}

}  // namespace terracut::hazards
