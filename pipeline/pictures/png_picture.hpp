// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "rt/error.hpp"

namespace terracut::pictures {

/// A colour in red, green and blue, each 0 to 255 as PNG stores them.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;

  bool operator==(const Colour&) const = default;
};

/// Mixes two colours: `from` at share 0, `to` at share 1; share is clamped to [0, 1].
[[nodiscard]] Colour mix(Colour from, Colour to, double share) noexcept;

/// A picture of height x width pixels, row-major from the top left, three bytes each without
/// padding. Drawing is clipped at the picture's edges.
class Picture {
 public:
  Picture(int width, int height, Colour background);

  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  [[nodiscard]] Colour at(int x, int y) const noexcept { return pixels_[index(x, y)]; }

  void set(int x, int y, Colour colour) noexcept;
  /// Blends `colour` over the pixel with the given opacity in [0, 1].
  void blend(int x, int y, Colour colour, double opacity) noexcept;
  /// Fills the pixels [left, left + width) x [top, top + height) with `colour`.
  void rectangle(int left, int top, int width, int height, Colour colour) noexcept;
  /// Draws a straight line of square pixels of the given width.
  void line(double from_x, double from_y, double to_x, double to_y, int width,
            Colour colour) noexcept;
  /// Draws a smooth-edged ring line of the given width, or a disc if radius <= width / 2.
  void circle(double centre_x, double centre_y, double radius, double width, Colour colour,
              double opacity) noexcept;

  /// Returns the picture at half the size, each pixel the mean of four; smooths the edges of a
  /// picture drawn at twice the size.
  [[nodiscard]] Picture halved() const;

  /// Returns the bytes of a PNG file (8-bit RGB). Fails with kWriteFailed if libpng fails.
  [[nodiscard]] Expected<std::vector<std::byte>> png() const;
  /// Writes a PNG file, which appears whole or not at all.
  [[nodiscard]] Status write_png(const std::filesystem::path& path) const;

 private:
  [[nodiscard]] bool contains(int x, int y) const noexcept {
    return x >= 0 && x < width_ && y >= 0 && y < height_;
  }
  [[nodiscard]] std::size_t index(int x, int y) const noexcept {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  int width_;
  int height_;
  std::vector<Colour> pixels_;
};
static_assert(sizeof(Colour) == 3, "pixels are handed to libpng as they lie");

}  // namespace terracut::pictures
