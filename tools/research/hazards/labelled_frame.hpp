// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "calib/mount/mount.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "ground_kind.hpp"
#include "tools/research/datasets/class_table.hpp"

namespace terracut::hazards {

/// The returns of a frame with their true classes. Each list has one element per return, in order
/// of return index. Vehicle frame (calib/mount/mount.hpp), metres.
struct LabelledFrame {
  /// A return's cell in the image.
  struct Cell {
    int row = 0, column = 0;
  };

  frame::ImageShape shape;
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< Start of every beam.
  std::vector<Eigen::Vector3d> at;
  std::vector<Eigen::Vector3d> beam;  ///< Direction from the sensor, length 1.
  std::vector<double> range_m;        ///< Distance from the sensor.
  std::vector<Cell> cell;
  std::vector<std::uint8_t> intensity;
  std::vector<std::uint16_t> class_id;
  std::vector<datasets::Role> role;  ///< By GroundDefinition::kAll.
  std::vector<std::optional<GroundKind>> ground;

  [[nodiscard]] std::size_t size() const noexcept { return at.size(); }
  /// Returns the horizontal distance of a return from the sensor.
  [[nodiscard]] double ground_range_m(std::size_t index) const noexcept {
    return (at[index] - sensor).head<2>().norm();
  }
};

/// Makes the frame from `image`. `truth` has the class of every return, as in label files.
[[nodiscard]] LabelledFrame labelled_frame(const frame::RangeImage& image,
                                           std::span<const std::uint32_t> truth,
                                           const mount::Mount& mount,
                                           const datasets::ClassTable& classes);

}  // namespace terracut::hazards
