// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "calib/mount/mount.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/scan/kitti_scan.hpp"
#include "rt/error.hpp"

namespace terracut::scan {

/// Puts clouds into range images without packets (`terracut segment`), and returns the labels in
/// the cloud's order.
///
/// Rows and columns follow the decoder's rule: row = rows - 1 - ring (row 0 is the lowest) and
/// column = azimuth / width of a column, clockwise from straight ahead. For a sensor upside down
/// row = ring, and clockwise is seen from above the vehicle. The mount moves the coordinates into
/// the vehicle frame. If several points fall into a cell, the nearest owns it, so the order of
/// points does not matter. Returns are numbered in the cloud's order. Points without a ring, and
/// points for which the overflow list has no room, are counted but not placed.
///
/// Allocates only for a cloud with more points than every cloud before and than reserve() was
/// given.
class ScanToImage {
 public:
  struct Summary {
    std::size_t placed = 0;
    /// Points without a valid position (is_place()); labelled frame::Label::kNone.
    std::size_t no_place = 0;
    /// Points with a valid position but no ring; labelled kObstacle, the safe side.
    std::size_t no_ring = 0;
    /// Points whose cell and overflow list were full; labelled kObstacle.
    std::size_t overflow_full = 0;
  };

  explicit ScanToImage(const mount::Mount& mount);

  /// Takes memory for clouds of `points` points.
  void reserve(std::size_t points);

  /// Clears `image`, which must have a row for every ring, and fills it with a cloud.
  /// `ring_of_point` has the ring of each point, 0 the highest, or kNoRing (always for points
  /// without a valid position).
  Summary place(std::span<const ScanPoint> points, std::span<const std::int16_t> ring_of_point,
                frame::RangeImage& image);

  /// Returns the cloud's point index for each return of the last place().
  [[nodiscard]] std::span<const std::uint32_t> point_of_return() const noexcept {
    return point_of_return_;
  }

  /// Gives each point of the last cloud, in the cloud's order, the label of its return; points
  /// without a return get the labels stated at Summary. `of_returns` has one label for every placed
  /// point.
  void labels_of_points(std::span<const frame::Label> of_returns,
                        std::vector<frame::Label>& of_points) const;

 private:
  mount::RigidTransform T_vehicle_lidar_;
  bool is_upside_down_;
  std::vector<std::uint32_t> point_of_return_;
  std::vector<frame::Label> label_without_return_;  ///< The label of each point that has no return.
};

}  // namespace terracut::scan
