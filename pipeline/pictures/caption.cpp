// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/pictures/caption.hpp"

#include "pipeline/pictures/frame_colours.hpp"
#include "pipeline/pictures/pixel_text.hpp"

namespace terracut::pictures {
namespace {

constexpr int kSwatchGlyphs = 4;  // Width of a swatch and its gap, in characters.

/// The position of a legend entry: pixels from the left, and lines from the first.
struct Place {
  int left = 0, line = 0;
};

void draw_swatch(Picture& picture, int left, int top, int scale, std::span<const Colour> colours) {
  const int width = (kSwatchGlyphs - 1) * kGlyphWidth * scale;
  for (int x = 0; x < width; ++x) {
    const auto colour =
        static_cast<std::size_t>(x) * colours.size() / static_cast<std::size_t>(width);
    picture.rectangle(left + x, top, 1, kGlyphHeight * scale, colours[colour]);
  }
}

}  // namespace

Picture with_caption(const Picture& picture, std::string_view title,
                     std::span<const LegendEntry> legend) {
  const int scale = picture.width() < 700 ? 1 : 2;
  const int margin = picture.width() / 40;
  const int line_height = 2 * kGlyphHeight * scale;

  std::vector<Place> places;
  Place next{margin, 1};
  for (const LegendEntry& entry : legend) {
    const int width = kSwatchGlyphs * kGlyphWidth * scale + text_width(entry.text, scale);
    if (next.left > margin && next.left + width > picture.width() - margin) {
      next = {margin, next.line + 1};
    }
    places.push_back(next);
    next.left += width + 2 * kGlyphWidth * scale;
  }

  const int lines = places.empty() ? 1 : places.back().line + 1;
  Picture captioned(picture.width(), picture.height() + lines * line_height + kGlyphHeight * scale,
                    kPictureBackground);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) captioned.set(x, y, picture.at(x, y));
  }
  const int top = picture.height() + kGlyphHeight * scale;
  draw_text(captioned, margin, top, title, scale, kTextColour);
  for (std::size_t i = 0; i < legend.size(); ++i) {
    const int line_top = top + places[i].line * line_height;
    draw_swatch(captioned, places[i].left, line_top, scale, legend[i].colours);
    draw_text(captioned, places[i].left + kSwatchGlyphs * kGlyphWidth * scale, line_top,
              legend[i].text, scale, kTextColour);
  }
  return captioned;
}

}  // namespace terracut::pictures
