// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <span>

#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "rt/error.hpp"
#include "terracut/frame.hpp"

namespace terracut::output {

/// Writes a frame as a binary PCD v0.7 file, one point a return in order of arrival, little-endian:
///
///   x, y, z    float32  metres, vehicle frame (z is the height above the mount's ground plane)
///   intensity  float32  0..255
///   ring       uint16   row of the range image, 0 is the lowest laser
///   label      uint16   SemanticKITTI class as in the .label files (label_sink.hpp)
///   height_above_ground  float32  metres, above the ground below the return; where there are
///   heights
///
/// `labels` and, unless empty, `heights_m` have one entry a return, by return index. Whole or not
/// at all; fails with kInvalidArgument if their number is not that of the returns.
[[nodiscard]] Status write_pcd(const std::filesystem::path& path, std::span<const Point> points,
                               std::span<const frame::Label> labels,
                               std::span<const float> heights_m = {});
[[nodiscard]] Status write_pcd(const std::filesystem::path& path, const frame::RangeImage& image,
                               std::span<const frame::Label> labels,
                               std::span<const float> heights_m = {});

}  // namespace terracut::output
