// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "pipeline/pictures/frame_colours.hpp"
#include "pipeline/pictures/png_picture.hpp"

namespace terracut::pictures {

/// What the bird's-eye view shows.
struct BirdEyeView {
  double side_m = 100;  ///< Length of the square's side; the sensor is in the middle. [10, 400]
  double pixels_per_m = 10;    ///< [2, 40]
  double ring_spacing_m = 10;  ///< Distance between the range rings, > 0.
};

/// Draws the frame from above, x (forward) up: colours of frame_colours.hpp, range rings, the
/// vehicle as an arrow, and at the lower left a scale bar of one ring spacing with its length.
/// Higher returns cover lower ones.
[[nodiscard]] Picture bird_eye_picture(const LabelledFrame& frame, const BirdEyeView& view = {});

/// A frame with its own colours, one a return.
struct ColouredFrame {
  const frame::RangeImage& image;
  std::span<const Colour> colours;  ///< One per return.
  /// By return index: returns of a higher level cover those of a lower one, whatever their heights.
  /// Empty: all of one level.
  std::span<const std::uint8_t> level;
};
[[nodiscard]] Picture bird_eye_picture(const ColouredFrame& frame, const BirdEyeView& view = {});

}  // namespace terracut::pictures
