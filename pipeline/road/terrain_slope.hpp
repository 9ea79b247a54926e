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

/// The slope of the terrain at large: for each square, a plane through the smooth ground of the
/// square and the eight squares around it. Edges are judged relative to this slope, so that a hill,
/// a banked road or a tilted sensor makes no edges.
class TerrainSlope {
 public:
  struct Config {
    float square_m = 5.0F;           ///< Side of a square; a plane covers 3 x 3 squares.
    float max_roughness_m = 0.006F;  ///< Rougher ground, such as a bank, is ignored.
  };

  /// The slope along x and along y, as rise over run.
  struct Gradient {
    float along_x = 0, along_y = 0;
    [[nodiscard]] float rise_m(float dx_m, float dy_m) const noexcept {
      return along_x * dx_m + along_y * dy_m;
    }
  };

  /// `patches` is the number of patches of the ground that will be fitted.
  TerrainSlope(const Config& config, std::size_t patches, memory::FixedMemory& memory);

  /// Fits planes to the ground. Real-time safe.
  void fit(const GroundPatches& ground) noexcept TERRACUT_NONBLOCKING;

  /// Returns the gradient at (x, y); beyond kReach_m the gradient of the nearest square.
  [[nodiscard]] const Gradient& at(float x_m, float y_m) const noexcept {
    return gradients_[static_cast<std::size_t>(square_of(x_m, y_m))];
  }
  /// Returns the gradient at a patch of the ground last fitted.
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
  int side_;  // number of squares per side
  std::span<Sums> sums_;
  std::span<Gradient> gradients_;
  std::span<std::int32_t> square_;  // square of each patch
};

}  // namespace terracut::road
