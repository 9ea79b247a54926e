// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <string_view>

namespace terracut::evaluation::report {

enum class TextAnchor { kStart, kMiddle, kEnd };

/// A small SVG drawing that stands in a page. Pixels, y downwards; colours as CSS writes them. A
/// `tip` is shown by browsers where the pointer rests.
class Svg {
 public:
  Svg(double width, double height, std::string_view alternative);

  void line(double x1, double y1, double x2, double y2, std::string_view colour, double width = 1);
  void rectangle(double x, double y, double width, double height, std::string_view colour,
                 std::string_view tip = {});
  void disc(double x, double y, double radius, std::string_view colour, std::string_view tip = {});
  /// A path's data as SVG writes it, drawn as a line with round ends.
  void stroke(std::string_view path, std::string_view colour, double width);
  void text(double x, double y, std::string_view text, TextAnchor anchor = TextAnchor::kStart);
  /// Reads upwards, its middle at the place.
  void upright_text(double x, double y, std::string_view text);

  /// The whole element.
  [[nodiscard]] std::string element() const { return body_ + "</svg>\n"; }

 private:
  std::string body_;
};

}  // namespace terracut::evaluation::report
