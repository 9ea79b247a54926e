// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "pipeline/pictures/frame_colours.hpp"
#include "pipeline/pictures/png_picture.hpp"

namespace terracut::pictures {

inline constexpr int kPixelsPerRow = 6;  ///< Height of a row: rows are far fewer than columns.

/// Draws the range image as a panorama of columns x (rows * kPixelsPerRow) pixels, and below it an
/// azimuth scale kAzimuthScaleHeight pixels high. Straight ahead is in the middle, the vehicle's
/// left on the left, row 0 (the lowest laser) at the bottom. Colours are those of
/// frame_colours.hpp, dimmed with distance. Cells without a return stay background, except a single
/// cell between two returns, which is drawn like the return on its left.
inline constexpr int kAzimuthScaleHeight = 28;
[[nodiscard]] Picture range_image_picture(const LabelledFrame& frame);

}  // namespace terracut::pictures
