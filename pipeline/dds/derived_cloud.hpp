// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "firmware_io/frame/label.hpp"
#include "ros_types.h"

namespace terracut::dds {

using RosCloud = sensor_msgs_msg_dds__PointCloud2_;

/// Returns the first byte of a point of a cloud, which must have passed terracut::unpack().
[[nodiscard]] inline const std::uint8_t* point_of(const RosCloud& cloud, std::size_t row,
                                                  std::size_t column) noexcept {
  const std::size_t row_step =
      cloud.row_step != 0 ? cloud.row_step : std::size_t{cloud.width} * cloud.point_step;
  return cloud.data._buffer + row * row_step + column * cloud.point_step;
}

/// A cloud made from another one. Its stamp, frame and field names stay in that original, which
/// must outlive this object and have passed terracut::unpack() with one label per point. The points
/// lie here, in memory that the next derived cloud reuses.
class DerivedCloud {
 public:
  /// Copies the points whose label `takes` accepts, byte for byte, into one row.
  template <class Takes>
  const RosCloud& select(const RosCloud& from, std::span<const frame::Label> labels, Takes takes) {
    const std::size_t step = from.point_step;
    data_.resize(labels.size() * step);
    std::uint8_t* to = data_.data();
    const frame::Label* label = labels.data();
    for (std::size_t row = 0; row < from.height; ++row) {
      const std::uint8_t* point = point_of(from, row, 0);
      for (std::size_t column = 0; column < from.width; ++column, ++label, point += step) {
        if (!takes(*label)) continue;
        std::memcpy(to, point, step);
        to += step;
      }
    }
    begin(from);
    const auto points =
        static_cast<std::uint32_t>(static_cast<std::size_t>(to - data_.data()) / step);
    set_size(1, points, from.point_step);
    cloud_.is_dense = true;  // points without a return have a label that no caller accepts
    return cloud_;
  }

  /// Copies all points in their order and adds a field at the end: label, uint8, with the classes
  /// of .label files (pipeline/output/label_sink.hpp). Where there are `heights_m`, one per point,
  /// height_above_ground, float32, follows.
  const RosCloud& with_labels(const RosCloud& from, std::span<const frame::Label> labels,
                              std::span<const float> heights_m = {});

 private:
  void begin(const RosCloud& from);
  void set_size(std::uint32_t height, std::uint32_t width, std::uint32_t point_step);

  RosCloud cloud_{};
  std::vector<sensor_msgs_msg_dds__PointField_> fields_;
  std::vector<std::uint8_t> data_;
};

}  // namespace terracut::dds
