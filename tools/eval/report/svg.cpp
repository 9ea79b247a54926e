// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "svg.hpp"

#include <fmt/format.h>

#include <iterator>

#include "html.hpp"

namespace terracut::evaluation::report {
namespace {

std::string_view anchor_name(TextAnchor anchor) {
  switch (anchor) {
    case TextAnchor::kMiddle:
      return "middle";
    case TextAnchor::kEnd:
      return "end";
    case TextAnchor::kStart:
      break;
  }
  return "start";
}

std::string tip_element(std::string_view tip) {
  return tip.empty() ? "" : "<title>" + escaped(tip) + "</title>";
}

}  // namespace

Svg::Svg(double width, double height, std::string_view alternative)
    : body_(fmt::format(
          R"(<svg viewBox="0 0 {0:.0f} {1:.0f}" width="{0:.0f}" height="{1:.0f}" role="img" aria-label="{2}">)",
          width, height, escaped(alternative))) {}

void Svg::line(double x1, double y1, double x2, double y2, std::string_view colour, double width) {
  fmt::format_to(
      std::back_inserter(body_),
      R"(<line x1="{:.1f}" y1="{:.1f}" x2="{:.1f}" y2="{:.1f}" stroke="{}" stroke-width="{:.1f}"/>)",
      x1, y1, x2, y2, colour, width);
}

void Svg::rectangle(double x, double y, double width, double height, std::string_view colour,
                    std::string_view tip) {
  fmt::format_to(
      std::back_inserter(body_),
      R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{:.1f}" fill="{}">{}</rect>)", x, y,
      width, height, colour, tip_element(tip));
}

void Svg::disc(double x, double y, double radius, std::string_view colour, std::string_view tip) {
  fmt::format_to(std::back_inserter(body_),
                 R"(<circle cx="{:.1f}" cy="{:.1f}" r="{:.1f}" fill="{}">{}</circle>)", x, y,
                 radius, colour, tip_element(tip));
}

void Svg::stroke(std::string_view path, std::string_view colour, double width) {
  fmt::format_to(
      std::back_inserter(body_),
      R"(<path d="{}" fill="none" stroke="{}" stroke-width="{:.1f}" stroke-linecap="round"/>)",
      path, colour, width);
}

void Svg::text(double x, double y, std::string_view text, TextAnchor anchor) {
  fmt::format_to(std::back_inserter(body_),
                 R"(<text x="{:.1f}" y="{:.1f}" text-anchor="{}">{}</text>)", x, y,
                 anchor_name(anchor), escaped(text));
}

void Svg::upright_text(double x, double y, std::string_view text) {
  fmt::format_to(
      std::back_inserter(body_),
      R"svg(<text transform="translate({:.1f} {:.1f}) rotate(-90)" text-anchor="middle">{}</text>)svg",
      x, y, escaped(text));
}

}  // namespace terracut::evaluation::report
