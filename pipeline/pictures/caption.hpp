// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/pictures/png_picture.hpp"

namespace terracut::pictures {

/// A colour, or a range of colours, and its meaning.
struct LegendEntry {
  std::string text;
  std::vector<Colour> colours;  ///< Colours of the swatch from left to right; at least one.
};

/// Returns `picture` with a band below it that holds the title and the legend. Long text is
/// continued on further lines.
[[nodiscard]] Picture with_caption(const Picture& picture, std::string_view title,
                                   std::span<const LegendEntry> legend);

}  // namespace terracut::pictures
