// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/remembered/street_grid.hpp"

#include <algorithm>

namespace terracut::remembered {
namespace {

/// Rounds down. Places lie within what a drive covers.
std::int64_t whole(double squares) noexcept {
  const auto towards_zero = static_cast<std::int64_t>(squares);
  return static_cast<double>(towards_zero) > squares ? towards_zero - 1 : towards_zero;
}

std::uint32_t modulo(std::int64_t square) noexcept {
  static_assert((StreetGrid::kSide & (StreetGrid::kSide - 1)) == 0);
  return static_cast<std::uint32_t>(square) & (StreetGrid::kSide - 1);
}

}  // namespace

StreetGrid::StreetGrid(const Config& config, memory::FixedMemory& memory)
    : per_metre_(1 / config.square_m),
      layers_per_metre_(1 / config.layer_m),
      keep_(static_cast<int>(config.keep * float{kOne})),
      squares_per_metre_(static_cast<double>(per_metre_)),
      boxes_(memory.take<Box>("street memory",
                              std::size_t{kSide} * std::size_t{kSide} * std::size_t{kLayers})) {
  int share = kOne;
  for (int& fade : fade_) {
    fade = share;
    share = share * keep_ / kOne;
  }
}

void StreetGrid::clear() noexcept {
  is_empty_ = true;
}

void StreetGrid::forget(std::uint32_t first_row, std::uint32_t rows, std::uint32_t first_column,
                        std::uint32_t columns) noexcept {
  constexpr auto kAll = static_cast<std::uint32_t>(kSide);
  for (std::uint32_t r = 0; r < rows; ++r) {
    const std::size_t row = (first_row + r) % kAll * std::size_t{kAll};
    for (std::uint32_t c = 0; c < columns; ++c) {
      const std::size_t square = row + (first_column + c) % kAll;
      std::fill_n(boxes_.begin() + static_cast<std::ptrdiff_t>(square * kLayers), kLayers, Box{});
    }
  }
}

void StreetGrid::begin_frame(const frame::Place& place) noexcept {
  constexpr auto kAll = static_cast<std::uint32_t>(kSide);
  const double x = place.x_m * squares_per_metre_, y = place.y_m * squares_per_metre_;
  const std::int64_t to_x = whole(x) - kSide / 2, to_y = whole(y) - kSide / 2;
  ++frame_;
  if (frame_ == 0) is_empty_ = true;  // the counter has wrapped
  const auto far = [](std::int64_t by) { return by <= -kSide || by >= kSide; };
  if (is_empty_ || far(to_x - square_x_) || far(to_y - square_y_)) {
    forget(0, kAll, 0, kAll);
    frame_ = std::max<std::uint32_t>(frame_, 1);
    is_empty_ = false;
  } else {
    // Rows and columns that enter the window on one side have left it on the other.
    const std::int64_t by_x = to_x - square_x_, by_y = to_y - square_y_;
    const auto count = [](std::int64_t by) {
      return static_cast<std::uint32_t>(by < 0 ? -by : by);
    };
    forget(modulo(by_y > 0 ? square_y_ : to_y), count(by_y), 0, kAll);
    forget(0, kAll, modulo(by_x > 0 ? square_x_ : to_x), count(by_x));
  }
  square_x_ = to_x;
  square_y_ = to_y;
  origin_x_ = modulo(to_x);
  origin_y_ = modulo(to_y);
  cosine_ = static_cast<float>(place.cosine);
  sine_ = static_cast<float>(place.sine);
  x_ = static_cast<float>(x - static_cast<double>(to_x));
  y_ = static_cast<float>(y - static_cast<double>(to_y));
}

}  // namespace terracut::remembered
