// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terracut/error.hpp"
#include "terracut/frame.hpp"

namespace terracut {

/// How the ground of a cell is known.
enum class GroundKnown : std::uint8_t {
  kUnknown = 0,       ///< Nothing near enough tells; height and slope are NaN.
  kSeen = 1,          ///< Returns labelled ground lie in the cell.
  kInterpolated = 2,  ///< From the ground around it: under things, or between rings.
};

/// The ground around the vehicle as square cells, from the labelled returns of one frame.
///
/// A cell with ground returns has their mean height. A cell with other returns alone has the ground
/// found below them (their z less their height above the ground). Any other cell is interpolated
/// between the nearest such cells on both sides in its row, in its column, or in both, where these
/// lie at most Config::longest_gap_m apart. The slope is that of the plane through the cell and
/// those around it.
///
/// All memory is taken in make(); update() allocates, locks and throws nothing. The same returns in
/// the same order give the same cells. One thread at a time.
class GroundGrid {
 public:
  struct Config {
    double cell_m = 0.5;         ///< Edge of a cell, [0.05, 10].
    double reach_m = 40;         ///< Cells lie in [-reach_m, reach_m) in x and y, [1, 250].
    double longest_gap_m = 4.0;  ///< Longest way over cells without returns, [0, 50].
  };

  /// Fails with kInvalidArgument for a setting out of range, or for more than 4,000 cells a side.
  [[nodiscard]] static Expected<GroundGrid> make(const Config& config);

  /// Replaces the cells by those of these returns. `points`, `labels` and `heights_m`, the heights
  /// above the ground, have one entry per return; points with a height that is NaN are left out.
  /// Fails with kInvalidArgument if their numbers differ, as they do of a frame without heights;
  /// the cells are then those of before.
  [[nodiscard]] Status update(std::span<const Point> points, std::span<const Label> labels,
                              std::span<const float> heights_m);
  [[nodiscard]] Status update(const Frame& frame) {
    return update(frame.points, frame.labels, frame.height_above_ground_m);
  }

  /// Returns the number of cells along each side. Cell (row, column) lies at [row * size() +
  /// column] of the arrays below; it begins at x = row * cell_m - reach_m and y = column * cell_m -
  /// reach_m of the vehicle frame (calibration.hpp).
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Returns the index of the cell that a place lies in; cells() if it lies in none.
  [[nodiscard]] std::size_t cell_at(float x_m, float y_m) const noexcept;
  [[nodiscard]] std::size_t cells() const noexcept { return height_m_.size(); }

  /// Returns the heights of the ground in the vehicle frame, metres: 0 is below the sensor.
  [[nodiscard]] std::span<const float> height_m() const noexcept { return height_m_; }
  /// Returns the slopes, degrees, [0, 90); NaN also where the cells around do not show a plane.
  [[nodiscard]] std::span<const float> slope_deg() const noexcept { return slope_deg_; }
  [[nodiscard]] std::span<const GroundKnown> known() const noexcept { return known_; }

 private:
  /// The sum of the heights in a cell, and how many they are.
  struct Sum {
    double height_m = 0;
    std::uint32_t count = 0;
  };
  /// The heights that other cells of its row and column give a cell.
  struct Between {
    float height_m = 0, weight = 0;
  };

  explicit GroundGrid(const Config& config);
  void sum_up(std::span<const Point> points, std::span<const Label> labels,
              std::span<const float> heights_m) noexcept;
  void interpolate() noexcept;
  /// Interpolates the cells `first + i * step`, i in [0, size()), between those that have a height.
  void interpolate_line(std::size_t first, std::size_t step) noexcept;
  void find_slopes() noexcept;
  [[nodiscard]] float slope_at(std::size_t row, std::size_t column) const noexcept;

  Config config_;
  float cells_per_m_;
  std::size_t size_;
  std::size_t longest_gap_;  // cells
  std::vector<Sum> ground_, other_;
  std::vector<Between> between_;
  std::vector<float> height_m_, slope_deg_;
  std::vector<GroundKnown> known_;
};

}  // namespace terracut
