// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/road/terrain_slope.hpp"

#include <algorithm>
#include <cmath>

#include "rt/vector_clones.hpp"

namespace terracut::road {
namespace {

/// Returns the row or column of squares that holds a coordinate, limited to the first and the last.
inline std::int32_t line_of(float coordinate_m, float square_m, float side) noexcept {
  const float line = coordinate_m / square_m + 0.5F * side;
  const float not_before = line > 0.0F ? line : 0.0F;  // this removes NaN
  return static_cast<std::int32_t>(not_before < side - 1 ? not_before : side - 1);
}

TERRACUT_VECTOR_CLONES void find_squares(const float* x_m, const float* y_m, std::size_t count,
                                         float square_m, int side, std::int32_t* square) noexcept {
  const auto lines = static_cast<float>(side);
  for (std::size_t i = 0; i < count; ++i) {
    square[i] = line_of(x_m[i], square_m, lines) * side + line_of(y_m[i], square_m, lines);
  }
}

}  // namespace

TerrainSlope::TerrainSlope(const Config& config, std::size_t patches, memory::FixedMemory& memory)
    : config_(config),
      side_(2 * static_cast<int>(std::ceil(kReach_m / config.square_m))),
      sums_(memory.take<Sums>("terrain slope", static_cast<std::size_t>(side_ * side_))),
      gradients_(memory.take<Gradient>("terrain slope", static_cast<std::size_t>(side_ * side_))),
      square_(memory.take<std::int32_t>("terrain slope", patches)) {}

std::int32_t TerrainSlope::square_of(float x_m, float y_m) const noexcept {
  const auto lines = static_cast<float>(side_);
  return line_of(x_m, config_.square_m, lines) * side_ + line_of(y_m, config_.square_m, lines);
}

void TerrainSlope::fit(const GroundPatches& ground) noexcept {
  find_squares(ground.x_m().data(), ground.y_m().data(), square_.size(), config_.square_m, side_,
               square_.data());
  std::fill(sums_.begin(), sums_.end(), Sums{});
  // Successive patches mostly lie in the same square, so its sums are kept locally.
  Sums at_hand;
  std::int32_t square = 0;
  for (std::size_t i = 0; i < square_.size(); ++i) {
    if (ground.has_ground()[i] == 0 || ground.roughness_m()[i] > config_.max_roughness_m) continue;
    if (square_[i] != square) {
      sums_[static_cast<std::size_t>(square)] = at_hand;
      square = square_[i];
      at_hand = sums_[static_cast<std::size_t>(square)];
    }
    // Patches are denser near the sensor; weighting by range makes every square metre count alike.
    const auto weight = static_cast<double>(ground.range_m()[i]);
    const auto x = static_cast<double>(ground.x_m()[i]);
    const auto y = static_cast<double>(ground.y_m()[i]);
    const auto z = static_cast<double>(ground.z_m()[i]);
    at_hand.weight += weight;
    at_hand.x += weight * x;
    at_hand.y += weight * y;
    at_hand.z += weight * z;
    at_hand.xx += weight * x * x;
    at_hand.xy += weight * x * y;
    at_hand.yy += weight * y * y;
    at_hand.xz += weight * x * z;
    at_hand.yz += weight * y * z;
  }
  sums_[static_cast<std::size_t>(square)] = at_hand;
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
  // Fits by least squares with a regularising term, so that ground seen only along one direction
  // gets no slope across it.
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

}  // namespace terracut::road
