// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "baseline.hpp"
#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::baselines {

/// The extended elevation map of Pfaff, Triebel and Burgard ("An efficient extension to elevation
/// maps for outdoor terrain mapping and loop closing", IJRR 26(2), 2007): squares of a fixed size,
/// each with one elevation. If the heights of a square vary much, it looks for a gap that the
/// vehicle fits through: points above the gap are an overhang, and the elevation is that of the
/// lowest interval. If the heights of the lowest interval still vary much, it is a vertical object
/// standing on its lowest return. Its sources and what they leave open are in
/// docs/decisions/0037-the-papers-baselines.md. Reports kElevationMap and kLabels.
class FixedGridElevationMap final : public Baseline {
 public:
  struct Config {
    float cell_m = 0.5F;  ///< Side of a square, [0.05, 10].
    /// Half the side of the map, [10, 250]; returns farther out count to its outermost squares.
    float extent_m = 120.0F;
    float sigma_m = 0.02F;           ///< Standard deviation of a height at range 0, (0, 1].
    float sigma_per_metre = 0.001F;  ///< Growth of sigma_m with range, [0, 0.1].
    float vertical_sigma_m = 0.06F;  ///< Heights that vary more are not one level, (0, 5].
    float vehicle_height_m = 2.0F;   ///< The vehicle can drive through larger gaps, [0.1, 1e9].
    float obstacle_height_m = 0.2F;  ///< Obstacles are this far above the elevation, (0, 5].
  };

  enum class SquareKind : std::uint8_t {
    kEmpty,     ///< No return.
    kLevel,     ///< One level, seen from above.
    kVertical,  ///< An upright object.
  };
  struct Square {
    SquareKind kind = SquareKind::kEmpty;  ///< The kind of the lowest interval.
    /// Elevation, metres above the mount's ground plane: the fused height of a level, the lowest
    /// return of a vertical object.
    float elevation_m = 0;
    /// Lower edge of the overhang above the gap; infinite if there is no gap.
    float overhang_m = std::numeric_limits<float>::infinity();
  };

  /// Takes all memory. `profile` is not used: the map has no rings.
  FixedGridElevationMap(const Config& config, const mount::RingProfile& profile,
                        frame::ImageShape shape, std::size_t return_capacity,
                        memory::FixedMemory& memory);

  /// Returns the square of a place on the ground. Real-time safe, any floats.
  [[nodiscard]] const Square& square_at(float x_m, float y_m) const noexcept {
    return squares_[square_of(x_m, y_m)];
  }

 private:
  void label_cells(const frame::RangeImage& image,
                   stage::StageObserver* observer) noexcept override;
  void put_labels(const frame::RangeImage& image) noexcept;
  struct Sample {
    float height_m;
    float weight;  // 1 / variance
  };

  [[nodiscard]] std::uint32_t square_of(float x_m, float y_m) const noexcept;
  void sort_returns_into_squares(const frame::RangeImage& image) noexcept;
  [[nodiscard]] Square fit(std::span<Sample> samples) const noexcept;
  [[nodiscard]] bool is_level(std::span<const Sample> samples) const noexcept;

  Config config_;
  int side_;                      // squares
  std::span<std::uint32_t> end_;  // by square: the index after its last sample
  std::span<Sample> samples_;     // all returns, square by square
  std::span<Square> squares_;
};

}  // namespace terracut::baselines
