// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string_view>

#include "pipeline/pictures/png_picture.hpp"

namespace terracut::pictures {

inline constexpr int kGlyphWidth = 6;   ///< A character and the gap after it, at scale 1.
inline constexpr int kGlyphHeight = 7;  ///< Without the descenders of g, p, q and y.

/// Returns the width of `text` in pixels.
[[nodiscard]] constexpr int text_width(std::string_view text, int scale) noexcept {
  return static_cast<int>(text.size()) * kGlyphWidth * scale;
}

/// Writes `text` with its upper left corner at (x, y). Each pixel of a glyph is drawn as scale x
/// scale pixels, scale >= 1. Non-ASCII bytes are drawn as '?'. Clips at the picture's edges.
void draw_text(Picture& picture, int x, int y, std::string_view text, int scale,
               Colour colour) noexcept;

}  // namespace terracut::pictures
