// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "file_pattern.hpp"
#include "firmware_io/frame/range_image.hpp"

namespace terracut::datasets {

enum class PointFormat : std::uint8_t {
  kKittiBin,     ///< float32 x y z remission
  kNuscenesBin,  ///< float32 x y z intensity ring, x to the right, y ahead.
  kPcd,
};
enum class LabelFormat : std::uint8_t { kUint32, kUint8 };
enum class RingSource : std::uint8_t {
  kOrder,  ///< Ring after ring from the top, as in KITTI's files.
  kField,  ///< Each point has the number of its laser.
};

/// The layout of labelled clouds on disk: the part `layout` of a class table
/// (semantickitti_classes.yaml explains the values).
struct CloudLayout {
  FilePattern sequences;
  FilePattern points;
  PointFormat point_format = PointFormat::kKittiBin;
  std::optional<FilePattern> labels;  ///< Label files; empty: the files of points hold labels.
  LabelFormat label_format = LabelFormat::kUint32;
  int rings = 0;
  int columns = frame::ImageShape{}.columns;  ///< Firings of a laser in one revolution.
  RingSource rings_from = RingSource::kOrder;
};

/// Returns the layout as one line: equal lines mean equal layouts.
[[nodiscard]] std::string to_string(const CloudLayout& layout);

}  // namespace terracut::datasets
