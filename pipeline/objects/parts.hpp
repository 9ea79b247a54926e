// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <cstring>
#include <span>

#include "firmware_io/frame/image_shape.hpp"
#include "firmware_io/frame/label.hpp"
#include "pipeline/stage/cell_planes.hpp"
#include "pipeline/stage/float_lanes.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::objects {

/// Cells are looked at eight at a time, as bits, the lowest for the first. Rows are padded to
/// sixteen cells.
inline constexpr std::uint32_t kEightCells = 8;

/// Returns a bit for each lane of eight that is set, the lowest for the first.
[[nodiscard]] inline std::uint32_t bits_of(stage::FourInts low, stage::FourInts high) noexcept {
  const stage::FourInts bits =
      (low & stage::FourInts{1, 2, 4, 8}) | (high & stage::FourInts{16, 32, 64, 128});
  std::uint64_t halves[2];
  std::memcpy(halves, &bits, sizeof(bits));
  const std::uint64_t half = halves[0] | halves[1];
  return static_cast<std::uint32_t>(half | half >> 32);
}

/// What obstacle cells are part of: bodies stand out of the ground; feet are low (growth, kerbs,
/// rough ground, and the lowest returns of bodies).
class Parts {
 public:
  Parts(frame::ImageShape shape, memory::FixedMemory& memory)
      : bodies_(memory.take<std::uint8_t>("objects", shape.cells() / kEightCells)),
        feet_(memory.take<std::uint8_t>("objects", shape.cells() / kEightCells)) {}

  /// Divides obstacle cells: feet are lower than `low_m` above the ground. Real-time safe.
  void divide(const stage::CellPlanes& planes, float low_m) noexcept TERRACUT_NONBLOCKING {
    const stage::FourFloats low = stage::FourFloats{} + low_m;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const std::uint32_t obstacles = obstacles_among(&planes.label[kEightCells * i]);
      const float* const height_m = &planes.height_m[kEightCells * i];
      const std::uint32_t are_low = obstacles == 0 ? 0
                                                   : bits_of(stage::load_four(height_m) < low,
                                                             stage::load_four(height_m + 4) < low);
      bodies_[i] = static_cast<std::uint8_t>(obstacles & ~are_low);
      feet_[i] = static_cast<std::uint8_t>(obstacles & are_low);
    }
  }

  /// Return the bits of the eight cells from `cell` on, a multiple of eight.
  [[nodiscard]] std::uint32_t bodies(std::size_t cell) const noexcept {
    return bodies_[cell / kEightCells];
  }
  [[nodiscard]] std::uint32_t feet(std::size_t cell) const noexcept {
    return feet_[cell / kEightCells];
  }

 private:
  [[nodiscard]] static std::uint32_t obstacles_among(const frame::Label* labels) noexcept {
    std::uint64_t eight;
    std::memcpy(&eight, labels, sizeof(eight));
    // Labels are less than four, and an obstacle is the one with the second bit alone.
    static_assert(static_cast<int>(frame::Label::kObstacle) == 2);
    constexpr std::uint64_t kLowestBits = 0x0101010101010101U;
    const std::uint64_t are_obstacles = (eight >> 1) & ~eight & kLowestBits;
    return static_cast<std::uint32_t>((are_obstacles * 0x0102040810204080U) >> 56);
  }

  std::span<std::uint8_t> bodies_, feet_;  // by eight cells
};

}  // namespace terracut::objects
