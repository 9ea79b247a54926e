// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/pictures/bird_eye_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "firmware_io/frame/each_return.hpp"
#include "pipeline/free_way/outline.hpp"
#include "pipeline/pictures/pixel_text.hpp"

namespace terracut::pictures {
namespace {

constexpr Colour kRingColour{120, 135, 155};
constexpr int kOversampling = 2;  // undone by Picture::halved()

/// Maps metres of the vehicle frame to the oversampled picture: x up, y to the left.
struct Canvas {
  Picture picture;
  double pixels_per_m;

  [[nodiscard]] double column(double y_m) const noexcept {
    return picture.width() / 2.0 - y_m * pixels_per_m;
  }
  [[nodiscard]] double line(double x_m) const noexcept {
    return picture.height() / 2.0 - x_m * pixels_per_m;
  }
};

/// Draws each return as 3 x 3 oversampled pixels; where several overlap, the highest is visible.
void draw_returns(Canvas& canvas, const ColouredFrame& frame) {
  const int width = canvas.picture.width(), height = canvas.picture.height();
  std::vector<float> top_m(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                           std::numeric_limits<float>::lowest());
  frame::for_each_return(frame.image, [&](const frame::PlacedReturn& placed) {
    const double column = canvas.column(static_cast<double>(placed.point.y_m));
    const double line = canvas.line(static_cast<double>(placed.point.x_m));
    if (!(column >= 0 && column < width && line >= 0 && line < height)) return;
    const Colour colour = frame.colours[placed.return_index];
    const float level =
        frame.level.empty() ? 0.0F : static_cast<float>(frame.level[placed.return_index]);
    constexpr float kLevel_m = 1e5F;  // more than any height
    const float rank = level * kLevel_m + placed.point.z_m;
    const int x = static_cast<int>(column), y = static_cast<int>(line);
    for (int py = std::max(y - 1, 0); py <= std::min(y + 1, height - 1); ++py) {
      for (int px = std::max(x - 1, 0); px <= std::min(x + 1, width - 1); ++px) {
        float& top = top_m[static_cast<std::size_t>(py) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(px)];
        if (rank < top) continue;
        top = rank;
        canvas.picture.set(px, py, colour);
      }
    }
  });
}

void draw_range_rings(Canvas& canvas, const BirdEyeView& view) {
  for (double radius_m = view.ring_spacing_m; radius_m < view.side_m * 0.71;
       radius_m += view.ring_spacing_m) {
    canvas.picture.circle(canvas.column(0), canvas.line(0), radius_m * canvas.pixels_per_m, 2.0,
                          kRingColour, 0.28);
  }
}

/// Draws an arrow head of a car's length: tip in front, notched tail.
void draw_vehicle(Canvas& canvas) {
  constexpr double kFront_m = 2.4, kTail_m = -1.8, kNotch_m = -0.9, kHalfWidth_m = 1.3;
  for (double x_m = kTail_m; x_m <= kFront_m; x_m += 0.5 / canvas.pixels_per_m) {
    const double outer_m = kHalfWidth_m * (kFront_m - x_m) / (kFront_m - kTail_m);
    const double inner_m =
        x_m < kNotch_m ? kHalfWidth_m * 0.8 * (kNotch_m - x_m) / (kNotch_m - kTail_m) : 0.0;
    for (double y_m = inner_m; y_m <= outer_m; y_m += 0.5 / canvas.pixels_per_m) {
      for (const double side : {-1.0, 1.0}) {
        canvas.picture.set(static_cast<int>(canvas.column(side * y_m)),
                           static_cast<int>(canvas.line(x_m)), kTextColour);
      }
    }
  }
}

/// Draws a scale bar of one ring spacing, with its length written above.
void draw_scale_bar(Canvas& canvas, const BirdEyeView& view) {
  const int length = static_cast<int>(view.ring_spacing_m * canvas.pixels_per_m);
  const int margin = canvas.picture.width() / 40;
  const int line = canvas.picture.height() - margin;
  constexpr int kThick = 2 * kOversampling, kTick = 8 * kOversampling;
  canvas.picture.rectangle(margin, line - kThick, length, kThick, kTextColour);
  canvas.picture.rectangle(margin, line - kTick, kThick, kTick, kTextColour);
  canvas.picture.rectangle(margin + length - kThick, line - kTick, kThick, kTick, kTextColour);
  const std::string text = fmt::format("{:g} m", view.ring_spacing_m);
  constexpr int kTextScale = 2 * kOversampling;
  draw_text(canvas.picture, margin + (length - text_width(text, kTextScale)) / 2,
            line - kThick - (kGlyphHeight + 2) * kTextScale, text, kTextScale, kTextColour);
}

void draw_around(Canvas& canvas, std::span<const Corner> corners, int width, Colour colour) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner &from = corners[i], &to = corners[(i + 1) % corners.size()];
    canvas.picture.line(canvas.column(static_cast<double>(from.y_m)),
                        canvas.line(static_cast<double>(from.x_m)),
                        canvas.column(static_cast<double>(to.y_m)),
                        canvas.line(static_cast<double>(to.x_m)), width * kOversampling, colour);
  }
}

/// Fills the area where ground was seen and nothing stands.
void draw_free_area(Canvas& canvas, std::span<const free_way::Sector> sectors) {
  if (sectors.empty()) return;
  for (int line = 0; line < canvas.picture.height(); ++line) {
    for (int column = 0; column < canvas.picture.width(); ++column) {
      const double x_m = (canvas.picture.height() / 2.0 - line - 0.5) / canvas.pixels_per_m;
      const double y_m = (canvas.picture.width() / 2.0 - column - 0.5) / canvas.pixels_per_m;
      const free_way::Sector& sector = free_way::sector_towards(
          free_way::clockwise_turns({static_cast<float>(x_m), static_cast<float>(y_m)}), sectors);
      if (std::hypot(x_m, y_m) >= static_cast<double>(sector.free_m())) continue;
      canvas.picture.set(column, line, kFreeAreaColour);
    }
  }
}

Picture draw(const ColouredFrame& frame, std::span<const objects::Object> objects,
             std::span<const free_way::Sector> free_way, const BirdEyeView& view) {
  const double pixels_per_m = kOversampling * std::clamp(view.pixels_per_m, 2.0, 40.0);
  const int side =
      static_cast<int>(std::lround(std::clamp(view.side_m, 10.0, 400.0) * pixels_per_m));
  Canvas canvas{Picture(side, side, kPictureBackground), pixels_per_m};
  draw_free_area(canvas, free_way);
  draw_returns(canvas, frame);
  draw_around(canvas, free_way::outline(free_way), 1, kFreeWayColour);
  for (const objects::Object& object : objects) {
    draw_around(canvas, object.box.corners(), 2, kObjectColour);
  }
  draw_range_rings(canvas, view);
  draw_vehicle(canvas);
  draw_scale_bar(canvas, view);
  return canvas.picture.halved();
}

}  // namespace

Picture bird_eye_picture(const LabelledFrame& frame, const BirdEyeView& view) {
  std::vector<Colour> colours(frame.labels.size());
  frame::for_each_return(frame.image, [&](const frame::PlacedReturn& placed) {
    colours[placed.return_index] = colour_of_return(frame, placed.return_index, placed.point);
  });
  // Mistakes are drawn over everything else: such a picture is made to show them.
  std::vector<std::uint8_t> mistaken;
  for (const Mistake mistake : frame.mistakes) mistaken.push_back(mistake != Mistake::kNone);
  return draw(ColouredFrame{frame.image, colours, mistaken}, frame.objects, frame.free_way, view);
}

Picture bird_eye_picture(const ColouredFrame& frame, const BirdEyeView& view) {
  return draw(frame, {}, {}, view);
}

}  // namespace terracut::pictures
