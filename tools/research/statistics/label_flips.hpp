// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "firmware_io/frame/label.hpp"
#include "firmware_io/scan/kitti_scan.hpp"
#include "tools/lab/encode/sensor_motion.hpp"
#include "tools/research/datasets/class_table.hpp"
#include "tools/research/statistics/frame_counts.hpp"

namespace terracut::statistics {

/// Measures how steady labels are: compares every point with the nearest point of the previous
/// frame, within 10 cm, after removing the sensor's motion. Both points must be of a class that is
/// in the table, is not ignored and does not move (SemanticKITTI's "moving-..." do).
class LabelFlips {
 public:
  LabelFlips(const datasets::ClassTable& classes, std::size_t methods);

  /// Takes the next frame. `before_this` transforms its points to the previous frame; it is empty
  /// if there is no previous frame or the motion since is unknown.
  void look_at(const scan::KittiScan& scan, const std::optional<encode::RigidMotion>& before_this);

  /// Counts the flips of one method, given a label per point of the latest frame.
  [[nodiscard]] FlipCounts count(std::size_t method, std::span<const frame::Label> labels);

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  enum class Truth : std::uint8_t { kLeftOut, kGround, kObstacle };
  struct Place {
    double x_m, y_m, z_m;
  };

  void find_truth(const scan::KittiScan& scan);
  void sort_into_voxels();
  [[nodiscard]] std::uint32_t nearest_before(const Place& place) const;

  const datasets::ClassTable& classes_;
  std::vector<Place> places_, places_before_;
  std::vector<Truth> truth_, truth_before_;
  /// Indexed by method, for the frame counted last.
  std::vector<std::vector<frame::Label>> labels_;
  std::vector<std::uint32_t> partners_;  ///< By point: partner in the previous frame.

  // The points of the previous frame by voxel, as linked lists that start at the voxel's hash.
  std::vector<std::uint32_t> first_in_voxel_, next_in_voxel_;
};

}  // namespace terracut::statistics
