// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "pipeline/pictures/frame_colours.hpp"
#include "pipeline/pictures/png_picture.hpp"

namespace terracut::pictures {

/// The area and the scale of the bird's-eye view.
struct BirdEyeView {
  double side_m = 100;  ///< Length of the square's side; the sensor is in the middle. [10, 400]
  double pixels_per_m = 10;    ///< [2, 40]
  double ring_spacing_m = 10;  ///< Distance between the range rings, > 0.
};

/// Draws the frame from above, x (forward) up: colours of frame_colours.hpp, boxes of objects,
/// range rings, the vehicle as an arrow, and at the lower left a scale bar of one ring spacing with
/// its length. Higher returns cover lower ones.
[[nodiscard]] Picture bird_eye_picture(const LabelledFrame& frame, const BirdEyeView& view = {});

/// A labelled frame with a colour chosen for each return.
struct ColouredFrame {
  const frame::RangeImage& image;
  std::span<const Colour> colours;  ///< One per return.
  /// Level of each return, by return index: a higher level covers a lower one, whatever the
  /// heights. Empty: all returns have the same level.
  std::span<const std::uint8_t> level;
};
[[nodiscard]] Picture bird_eye_picture(const ColouredFrame& frame, const BirdEyeView& view = {});

}  // namespace terracut::pictures
