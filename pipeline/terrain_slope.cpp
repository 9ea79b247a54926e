// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/terrain_slope.hpp"

#include <algorithm>
#include <cmath>

namespace terracut::pipeline {

TerrainSlope::TerrainSlope(const Config& config, rt::FixedMemory& memory)
    : config_(config),
      side_(2 * static_cast<int>(std::ceil(kReach_m / config.square_m))),
      sums_(memory.take<Sums>("terrain slope", static_cast<std::size_t>(side_ * side_))),
      gradients_(memory.take<Gradient>("terrain slope", static_cast<std::size_t>(side_ * side_))) {}

int TerrainSlope::line_of(float coordinate_m) const noexcept {
  const float line = coordinate_m / config_.square_m + 0.5F * static_cast<float>(side_);
  return line > 0 ? std::min(static_cast<int>(std::min(line, 1e6F)), side_ - 1) : 0;
}

void TerrainSlope::fit(const GroundPatches& ground) noexcept {
  std::fill(sums_.begin(), sums_.end(), Sums{});
  for (const GroundPatches::Patch& patch : ground.patches()) {
    if (!patch.has_ground || patch.roughness_m > config_.max_roughness_m) continue;
    // Patches lie the denser the nearer; weighed by range, every square metre says about as much.
    const double weight = static_cast<double>(patch.range_m);
    const auto x = static_cast<double>(patch.x_m);
    const auto y = static_cast<double>(patch.y_m);
    const auto z = static_cast<double>(patch.z_m);
    Sums& sums = sums_[square_of(patch.x_m, patch.y_m)];
    sums.weight += weight;
    sums.x += weight * x;
    sums.y += weight * y;
    sums.z += weight * z;
    sums.xx += weight * x * x;
    sums.xy += weight * x * y;
    sums.yy += weight * y * y;
    sums.xz += weight * x * z;
    sums.yz += weight * y * z;
  }
  for (int line_x = 0; line_x < side_; ++line_x) {
    for (int line_y = 0; line_y < side_; ++line_y) {
      gradients_[static_cast<std::size_t>(line_x * side_ + line_y)] =
          gradient_around(line_x, line_y);
    }
  }
}

TerrainSlope::Gradient TerrainSlope::gradient_around(int line_x, int line_y) const noexcept {
  Sums all;
  for (int near_x = std::max(line_x - 1, 0); near_x <= std::min(line_x + 1, side_ - 1); ++near_x) {
    for (int near_y = std::max(line_y - 1, 0); near_y <= std::min(line_y + 1, side_ - 1);
         ++near_y) {
      const Sums& sums = sums_[static_cast<std::size_t>(near_x * side_ + near_y)];
      all.weight += sums.weight;
      all.x += sums.x;
      all.y += sums.y;
      all.z += sums.z;
      all.xx += sums.xx;
      all.xy += sums.xy;
      all.yy += sums.yy;
      all.xz += sums.xz;
      all.yz += sums.yz;
    }
  }
  if (all.weight <= 0) return {};
  // Least squares. What is known in one direction only stays level across it.
  constexpr double kLevel_m2 = 4.0;
  const double x = all.x / all.weight, y = all.y / all.weight, z = all.z / all.weight;
  const double xx = all.xx / all.weight - x * x + kLevel_m2;
  const double xy = all.xy / all.weight - x * y;
  const double yy = all.yy / all.weight - y * y + kLevel_m2;
  const double xz = all.xz / all.weight - x * z;
  const double yz = all.yz / all.weight - y * z;
  const double determinant = xx * yy - xy * xy;
  return {static_cast<float>((xz * yy - yz * xy) / determinant),
          static_cast<float>((yz * xx - xz * xy) / determinant)};
}

}  // namespace terracut::pipeline
