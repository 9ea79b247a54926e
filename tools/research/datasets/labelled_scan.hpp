// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/ring_recovery.hpp"
#include "rt/error.hpp"
#include "tools/research/datasets/cloud_layout.hpp"

namespace terracut::datasets {

/// One labelled frame. Buffers are reused for the next frame.
struct LabelledScan {
  scan::KittiScan scan;  ///< Points in the sensor frame, and one label per point.
  std::vector<std::uint16_t> laser_of_point;  ///< Empty unless the layout's rings are a field.
  scan::RingRecovery rings;                   ///< The ring of every point.
};

/// Reads the points of a file, with their lasers and labels if the file has fields for them. Errors
/// name the file. Fails with the errors of its format, and with kMalformed for a missing field,
/// impossible numbers of lasers or labels, or no valid point.
[[nodiscard]] Status read_points(const CloudLayout& layout, const std::filesystem::path& file,
                                 LabelledScan& to);

/// Reads the labels of the points from a file of their own. Fails with the errors of
/// scan::read_label_file().
[[nodiscard]] Status read_labels(LabelFormat format, const std::filesystem::path& file,
                                 scan::KittiScan& to);

}  // namespace terracut::datasets
