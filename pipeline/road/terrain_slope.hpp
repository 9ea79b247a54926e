// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "pipeline/road/ground_patches.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::road {

/// How the terrain inclines at large: planes through the smooth ground of squares and the eight
/// around each. What it is for: an edge is where the ground rises against the terrain, whether the
/// road lies on a hill, is banked, or the sensor is mounted tilted.
class TerrainSlope {
 public:
  struct Config {
    float square_m = 5.0F;           ///< Side of a square; a plane covers three by three of them.
    float max_roughness_m = 0.006F;  ///< Rougher ground has no say: banks beside the road.
  };

  /// Rise over run towards x and y.
  struct Gradient {
    float along_x = 0, along_y = 0;
    [[nodiscard]] float rise_m(float dx_m, float dy_m) const noexcept {
      return along_x * dx_m + along_y * dy_m;
    }
  };

  /// `patches`: how many the ground to come has.
  TerrainSlope(const Config& config, std::size_t patches, memory::FixedMemory& memory);

  /// Fits the planes. Real-time safe.
  void fit(const GroundPatches& ground) noexcept TERRACUT_NONBLOCKING;

  /// The gradient where (x, y) is; beyond kReach_m that of the nearest square.
  [[nodiscard]] const Gradient& at(float x_m, float y_m) const noexcept {
    return gradients_[static_cast<std::size_t>(square_of(x_m, y_m))];
  }
  /// The same where a patch of the ground last fitted is.
  [[nodiscard]] const Gradient& at_patch(std::size_t patch) const noexcept {
    return gradients_[static_cast<std::size_t>(square_[patch])];
  }

  static constexpr float kReach_m = 60.0F;

 private:
  /// Weighted sums over the patches of a square.
  struct Sums {
    double weight = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;
  };

  [[nodiscard]] std::int32_t square_of(float x_m, float y_m) const noexcept TERRACUT_NONBLOCKING;
  [[nodiscard]] Gradient gradient_around(int line_x, int line_y) const noexcept;

  Config config_;
  int side_;  // squares
  std::span<Sums> sums_;
  std::span<Gradient> gradients_;
  std::span<std::int32_t> square_;  // by patch
};

}  // namespace terracut::road
