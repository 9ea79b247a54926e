// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string_view>

#include "pipeline/pictures/png_picture.hpp"

namespace terracut::pictures {

inline constexpr int kGlyphWidth = 6;   ///< Of one character and the gap behind it, at scale 1.
inline constexpr int kGlyphHeight = 7;  ///< Above the lower edge of g, p, q and y.

/// How many pixels wide `text` is drawn.
[[nodiscard]] constexpr int text_width(std::string_view text, int scale) noexcept {
  return static_cast<int>(text.size()) * kGlyphWidth * scale;
}

/// Writes `text` with its upper left corner at (x, y), each pixel of a glyph scale x scale pixels,
/// scale >= 1. Glyphs are those of ASCII; any other byte is drawn as '?'. What lies outside the
/// picture leaves no trace.
void draw_text(Picture& picture, int x, int y, std::string_view text, int scale,
               Colour colour) noexcept;

}  // namespace terracut::pictures
