// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/pictures/range_image_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "firmware_io/frame/each_return.hpp"
#include "pipeline/pictures/pixel_text.hpp"

namespace terracut::pictures {
namespace {

/// Darkens a colour with distance, so that depth edges show, but not so much that far returns
/// vanish.
Colour dimmed(Colour colour, double range_m) noexcept {
  constexpr double kFar_m = 80, kMostDimming = 0.55;
  return mix(colour, kPictureBackground, kMostDimming * std::min(range_m / kFar_m, 1.0));
}

/// Draws ticks every 45 degrees from straight ahead, with numbers.
void draw_azimuth_scale(Picture& picture) {
  constexpr int kTick = 6, kScale = 2;
  const int top = picture.height() - kAzimuthScaleHeight;
  picture.rectangle(0, top, picture.width(), kAzimuthScaleHeight, kPictureBackground);
  for (int azimuth_deg = -135; azimuth_deg <= 135; azimuth_deg += 45) {
    const int x = picture.width() / 2 + picture.width() * azimuth_deg / 360;
    const std::string text = azimuth_deg == 0 ? "ahead"
                                              : fmt::format("{} deg {}", std::abs(azimuth_deg),
                                                            azimuth_deg < 0 ? "left" : "right");
    picture.rectangle(x, top, kScale, kTick, kTextColour);
    draw_text(picture, x - text_width(text, kScale) / 2, top + kTick + kScale, text, kScale,
              kTextColour);
  }
}

/// Fills a single empty column between two returns: a gap of the sampling, not of the scene.
void close_lone_gaps(Picture& picture) noexcept {
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 1; x + 1 < picture.width(); ++x) {
      const bool lone = picture.at(x, y) == kPictureBackground &&
                        picture.at(x - 1, y) != kPictureBackground &&
                        picture.at(x + 1, y) != kPictureBackground;
      if (lone) picture.set(x, y, picture.at(x - 1, y));
    }
  }
}

/// True if columns go counter-clockwise, as in packets of a sensor mounted upside down.
bool is_mirrored(const frame::RangeImage& image) noexcept {
  std::int64_t clockwise = 0;
  frame::for_each_return(image, [&](const frame::PlacedReturn& placed) {
    if (placed.point.y_m == 0) return;
    const bool is_right = placed.point.y_m < 0;
    clockwise += is_right == (placed.column < image.shape().columns / 2) ? 1 : -1;
  });
  return clockwise < 0;
}

}  // namespace

Picture range_image_picture(const LabelledFrame& frame) {
  const frame::ImageShape& shape = frame.image.shape();
  Picture picture(shape.columns, shape.rows * kPixelsPerRow + kAzimuthScaleHeight,
                  kPictureBackground);
  const bool mirrored = is_mirrored(frame.image);
  frame::for_each_return(frame.image, [&](const frame::PlacedReturn& placed) {
    // Column 0 is straight ahead and columns go clockwise; straight ahead is drawn in the middle,
    // so columns are shifted by half a revolution.
    const int from_left = (placed.column + shape.columns / 2) % shape.columns;
    const int x = mirrored ? shape.columns - 1 - from_left : from_left;
    const int y = (shape.rows - 1 - placed.row) * kPixelsPerRow;
    Colour colour = colour_of_return(frame, placed.return_index, placed.point);
    const bool mistaken =
        !frame.mistakes.empty() && frame.mistakes[placed.return_index] != Mistake::kNone;
    if (!mistaken) colour = dimmed(colour, static_cast<double>(placed.point.ground_range_m));
    picture.rectangle(x, y, 1, kPixelsPerRow, colour);
  });
  close_lone_gaps(picture);
  draw_azimuth_scale(picture);
  return picture;
}

}  // namespace terracut::pictures
