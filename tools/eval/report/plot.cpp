// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "plot.hpp"

#include <fmt/format.h>

#include <cmath>

namespace terracut::evaluation::report {
namespace {

constexpr std::string_view kGridColour = "#d9dee5";
constexpr std::string_view kAxisColour = "#6b7480";

/// The smallest of 1, 2, 5 times a power of ten that is not below `value` (> 0).
double round_up(double value) {
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= value * (1 - 1e-9)) return step * power;
  }
  return 10 * power;
}

}  // namespace

AxisRange from_zero(double largest) {
  if (!(largest > 0)) return {0, 1};
  const double step = round_up(largest / 5);
  return {0, step * std::ceil(largest / step * (1 - 1e-9))};
}

double tick_step(const AxisRange& range, int wished) {
  return round_up((range.to - range.from) / wished);
}

Plot::Plot(double width, double height, AxisRange x, AxisRange y, std::string_view alternative)
    : width_(width), height_(height), x_(x), y_(y), svg_(width, height, alternative) {}

double Plot::x(double value) const {
  return kLeft + (value - x_.from) / (x_.to - x_.from) * (width_ - kLeft - kRight);
}

double Plot::y(double value) const {
  return height_ - kBottom - (value - y_.from) / (y_.to - y_.from) * (height_ - kTop - kBottom);
}

void Plot::y_axis(std::string_view title) {
  const double step = tick_step(y_, 5);
  for (double value = std::ceil(y_.from / step) * step; value <= y_.to + step * 1e-6;
       value += step) {
    svg_.line(kLeft, y(value), width_ - kRight, y(value), kGridColour);
    svg_.text(kLeft - 6, y(value) + 4, fmt::format("{:.6g}", value), TextAnchor::kEnd);
  }
  svg_.upright_text(13, (kTop + height_ - kBottom) / 2, title);
}

void Plot::x_axis(std::string_view title) {
  const double step = tick_step(x_, 8);
  for (double value = std::ceil(x_.from / step) * step; value <= x_.to + step * 1e-6;
       value += step) {
    svg_.line(x(value), height_ - kBottom, x(value), height_ - kBottom + 4, kAxisColour);
    x_label(value, fmt::format("{:.6g}", value));
  }
  svg_.line(kLeft, height_ - kBottom, width_ - kRight, height_ - kBottom, kAxisColour);
  svg_.text((kLeft + width_ - kRight) / 2, height_ - 6, title, TextAnchor::kMiddle);
}

void Plot::x_label(double value, std::string_view text) {
  svg_.text(x(value), height_ - kBottom + 17, text, TextAnchor::kMiddle);
}

}  // namespace terracut::evaluation::report
