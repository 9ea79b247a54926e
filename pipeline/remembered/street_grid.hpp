// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/frame/deskew_info.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::remembered {

/// Remembers what earlier frames saw of the street around the vehicle, in boxes: squares of the
/// ground plane, cut into layers of height above the ground found there. As heights are not
/// measured from the mount's plane, neither a nod of the vehicle nor a hill moves the memory.
///
/// The squares stand still while the vehicle drives over them; they are stored modulo kSide and
/// forgotten once outside the window. A box keeps the mean evidence of a frame's returns, from
/// -kSure (obstacle) to kSure (ground), and a share of the evidence of earlier frames, which
/// shrinks from frame to frame.
///
/// Takes all memory in the constructor. One thread; real-time safe.
class StreetGrid {
 public:
  struct Config {
    float square_m = 0.4F;  ///< Side of a square, [0.1, 2]
    float layer_m = 0.1F;   ///< Height of a layer, [0.02, 1]
    float keep = 0.5F;      ///< Share of the memory kept from frame to frame, [0, 1).
  };
  static constexpr int kSide = 256, kLayers = 8;  ///< Squares per side of the window, and layers.
  static constexpr int kLayersBelow = 2;          ///< Layers below the ground.
  static constexpr int kSure = 127;
  static constexpr std::uint32_t kOutside = UINT32_MAX;

  StreetGrid(const Config& config, memory::FixedMemory& memory);

  void clear() noexcept TERRACUT_NONBLOCKING;
  /// Begins a frame with the sensor at `place`. The place must be on the same journey as the last
  /// frame's, unless everything was forgotten.
  void begin_frame(const frame::Place& place) noexcept TERRACUT_NONBLOCKING;

  /// Returns the square at (x_m, y_m) in the frame; kOutside beyond the window.
  [[nodiscard]] std::uint32_t square_of(float x_m, float y_m) const noexcept {
    const float x = (cosine_ * x_m - sine_ * y_m) * per_metre_ + x_;
    const float y = (sine_ * x_m + cosine_ * y_m) * per_metre_ + y_;
    // The condition is also true for NaN.
    if (!(x >= 0 && x < float{kSide} && y >= 0 && y < float{kSide})) return kOutside;
    const auto column = static_cast<std::uint32_t>(x) + origin_x_;
    const auto row = static_cast<std::uint32_t>(y) + origin_y_;
    return (row % kSide) * kSide + column % kSide;
  }
  /// Returns the box of a return in a square, by the return's height above the ground; kOutside
  /// above and below the layers.
  [[nodiscard]] std::uint32_t box_of(std::uint32_t square, float height_m) const noexcept {
    const float layer = height_m * layers_per_metre_ + float{kLayersBelow};
    if (!(layer >= 0 && layer < float{kLayers})) return kOutside;
    return square * kLayers + static_cast<std::uint32_t>(layer);
  }

  /// Returns the evidence of earlier frames for a box, faded; 0 if there is none.
  [[nodiscard]] int said_before(std::uint32_t box) const noexcept {
    const Box& known = boxes_[box];
    if (known.frame == frame_) return known.before;
    return faded(known);
  }
  /// Adds a return's evidence, from -kSure (obstacle) to kSure (ground), to a box.
  void add(std::uint32_t box, int says) noexcept {
    Box& known = boxes_[box];
    if (known.frame != frame_) known = {.before = faded(known), .frame = frame_};
    if (known.returns == kMostReturns) return;
    known.sum = static_cast<std::int16_t>(known.sum + says);
    ++known.returns;
  }

 private:
  static constexpr int kMostReturns = 250;
  static constexpr std::uint32_t kOldest = 16;  ///< In frames; older memory is forgotten.

  /// `before` and the mean of `sum` are combined only when the next frame adds to the box.
  struct Box {
    std::int16_t sum = 0;
    std::uint8_t returns = 0;
    std::int8_t before = 0;
    std::uint32_t frame = 0;  ///< Newest frame that added to the box; 0: none.
  };

  [[nodiscard]] std::int8_t faded(const Box& box) const noexcept {
    const std::uint32_t age = frame_ - box.frame;
    if (box.frame == 0 || age > kOldest) return 0;
    // The newest frame's evidence gets the weight that the older evidence loses.
    const int mean = box.sum / (box.returns == 0 ? 1 : int{box.returns});
    const int known = (box.before * keep_ + mean * (kOne - keep_)) / kOne;
    return static_cast<std::int8_t>(known * fade_[age - 1] / kOne);
  }
  void forget(std::uint32_t first_row, std::uint32_t rows, std::uint32_t first_column,
              std::uint32_t columns) noexcept;

  static constexpr int kOne = 256;

  float per_metre_, layers_per_metre_;
  int keep_;                ///< Share kept per frame, in units of 1 / kOne.
  int fade_[kOldest] = {};  ///< keep_ to the powers 0, 1, ..., in the same units.
  std::uint32_t frame_ = 0;
  bool is_empty_ = true;
  std::int64_t square_x_ = 0, square_y_ = 0;     ///< Lowest corner of the window, in squares.
  std::uint32_t origin_x_ = 0, origin_y_ = 0;    ///< square_x_, square_y_ modulo kSide.
  float cosine_ = 1, sine_ = 0, x_ = 0, y_ = 0;  ///< From frame to window.
  double squares_per_metre_;
  std::span<Box> boxes_;
};

}  // namespace terracut::remembered
