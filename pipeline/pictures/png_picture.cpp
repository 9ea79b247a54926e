// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/pictures/png_picture.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>

#include "rt/files/whole_file.hpp"

namespace terracut::pictures {
namespace {

std::uint8_t mix(std::uint8_t from, std::uint8_t to, double share) noexcept {
  return static_cast<std::uint8_t>(std::lround(from + (to - from) * share));
}

}  // namespace

Colour mix(Colour from, Colour to, double share) noexcept {
  const double s = std::clamp(share, 0.0, 1.0);
  return {mix(from.red, to.red, s), mix(from.green, to.green, s), mix(from.blue, to.blue, s)};
}

Picture::Picture(int width, int height, Colour background)
    : width_(width),
      height_(height),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), background) {}

void Picture::set(int x, int y, Colour colour) noexcept {
  if (contains(x, y)) pixels_[index(x, y)] = colour;
}

void Picture::blend(int x, int y, Colour colour, double opacity) noexcept {
  if (contains(x, y)) pixels_[index(x, y)] = mix(pixels_[index(x, y)], colour, opacity);
}

void Picture::rectangle(int left, int top, int width, int height, Colour colour) noexcept {
  for (int y = top; y < top + height; ++y) {
    for (int x = left; x < left + width; ++x) set(x, y, colour);
  }
}

void Picture::line(double from_x, double from_y, double to_x, double to_y, int width,
                   Colour colour) noexcept {
  const double x = to_x - from_x, y = to_y - from_y;
  const int steps = 1 + static_cast<int>(std::max(std::abs(x), std::abs(y)));
  for (int step = 0; step <= steps; ++step) {
    const double share = static_cast<double>(step) / steps;
    rectangle(static_cast<int>(std::lround(from_x + share * x)) - width / 2,
              static_cast<int>(std::lround(from_y + share * y)) - width / 2, width, width, colour);
  }
}

void Picture::circle(double centre_x, double centre_y, double radius, double width, Colour colour,
                     double opacity) noexcept {
  const double reach = width / 2 + 0.5;
  const double outer = radius + reach + 1, inner = std::max(radius - reach - 1, 0.0);
  const int top = std::max(0, static_cast<int>(centre_y - outer));
  const int bottom = std::min(height_ - 1, static_cast<int>(centre_y + outer));
  for (int y = top; y <= bottom; ++y) {
    const double dy = y + 0.5 - centre_y;
    const auto half_chord = [&](double of_radius) {
      return std::sqrt(std::max(of_radius * of_radius - dy * dy, 0.0));
    };
    const auto blend_between = [&](double from_x, double to_x) {
      const int right = std::min(width_ - 1, static_cast<int>(to_x));
      for (int x = std::max(0, static_cast<int>(from_x)); x <= right; ++x) {
        const double distance = std::hypot(x + 0.5 - centre_x, dy);
        const double coverage = reach - std::abs(distance - radius);
        if (coverage > 0) blend(x, y, colour, opacity * std::min(coverage, 1.0));
      }
      return right;
    };
    // Skips the inside of the ring, which is most of the row.
    const int left_end = blend_between(centre_x - half_chord(outer), centre_x - half_chord(inner));
    blend_between(std::max(centre_x + half_chord(inner) - 1, left_end + 1.0),
                  centre_x + half_chord(outer));
  }
}

Picture Picture::halved() const {
  Picture half(width_ / 2, height_ / 2, {});
  for (int y = 0; y < half.height_; ++y) {
    for (int x = 0; x < half.width_; ++x) {
      const Colour a = at(2 * x, 2 * y), b = at(2 * x + 1, 2 * y);
      const Colour c = at(2 * x, 2 * y + 1), d = at(2 * x + 1, 2 * y + 1);
      half.set(x, y,
               {static_cast<std::uint8_t>((a.red + b.red + c.red + d.red + 2) / 4),
                static_cast<std::uint8_t>((a.green + b.green + c.green + d.green + 2) / 4),
                static_cast<std::uint8_t>((a.blue + b.blue + c.blue + d.blue + 2) / 4)});
    }
  }
  return half;
}

Expected<std::vector<std::byte>> Picture::png() const {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_);
  image.height = static_cast<png_uint_32>(height_);
  image.format = PNG_FORMAT_RGB;
  std::vector<std::byte> file(pixels_.size() * sizeof(Colour) + 65536);
  png_alloc_size_t size = file.size();
  if (png_image_write_to_memory(&image, file.data(), &size, 0, pixels_.data(), 0, nullptr) == 0) {
    return fail(ErrorCode::kWriteFailed,
                fmt::format("could not compress a {} x {} picture: libpng says '{}'", width_,
                            height_, static_cast<const char*>(image.message)));
  }
  file.resize(size);
  return file;
}

Status Picture::write_png(const std::filesystem::path& path) const {
  const auto file = png();
  if (!file) {
    return fail(file.error().code, fmt::format("{}: {}", path.string(), file.error().message));
  }
  return files::write_whole_file(path, *file);
}

}  // namespace terracut::pictures
