// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "pipeline/pictures/frame_colours.hpp"
#include "pipeline/pictures/png_picture.hpp"

namespace terracut::pictures {

inline constexpr int kPixelsPerRow = 6;  ///< Height of a row: rows are far fewer than columns.

/// Draws the range image as a panorama, columns x (rows * kPixelsPerRow) pixels, and below it
/// kAzimuthScaleHeight pixels with the azimuth: straight ahead in the middle, left of the vehicle
/// on the left, sky up (row 0, the lowest laser, at the bottom). Colours of frame_colours.hpp,
/// dimmed with distance. Cells without a return stay background, except a single one between two
/// returns, which is drawn like its left neighbour.
inline constexpr int kAzimuthScaleHeight = 28;
[[nodiscard]] Picture range_image_picture(const LabelledFrame& frame);

}  // namespace terracut::pictures
