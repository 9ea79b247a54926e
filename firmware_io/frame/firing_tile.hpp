// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rt/threads/nonblocking.hpp"

namespace terracut::frame {

/// The number of firings processed together: enough to fill vectors with one laser's returns, few
/// enough that the returns of all lasers stay in the cache next to the core.
inline constexpr std::size_t kTileFirings = 24;
/// A bit for each firing of a tile.
inline constexpr std::uint32_t kAllFirings = (std::uint32_t{1} << kTileFirings) - 1;
/// One value for each firing of a tile.
template <class Value>
using TileRow = std::array<Value, kTileFirings>;

/// Calls `visit(firing)` for each bit of the mask that is set, in ascending order.
template <class Visit>
void for_each_firing(std::uint32_t firings, Visit visit) noexcept {
  for (; firings != 0; firings &= firings - 1) {
    visit(static_cast<std::size_t>(std::countr_zero(firings)));
  }
}

/// Points of one laser of a tile in the vehicle frame, metres; NaN where the laser has no return.
struct TilePoints {
  alignas(64) TileRow<float> x_m;
  alignas(64) TileRow<float> y_m;
  alignas(64) TileRow<float> z_m;
  alignas(64) TileRow<float> ground_range_m;
};
/// Where to write points: arrays of kTileFirings each.
struct PointsOut {
  float *x_m, *y_m, *z_m, *ground_range_m;
};
[[nodiscard]] inline PointsOut all_of(TilePoints& points) noexcept {
  return {points.x_m.data(), points.y_m.data(), points.z_m.data(), points.ground_range_m.data()};
}

/// The image columns of one laser's beams in a tile, counted from the first column of some frame;
/// the n-th frame after that one begins at n times the columns of a frame.
struct BeamColumns {
  alignas(64) TileRow<std::int32_t> column;
  std::int32_t least = 0, most = 0;
  bool is_one_run = false;  ///< True if each firing is one column after the firing before.
};

/// The head's azimuth at each firing of a tile.
struct TileHeads {
  TileRow<std::int32_t> head_cdeg;  ///< Counts on over revolutions, from the start of some frame.
  /// What the sensor's trait computes each laser's advance from (decode/sensor_trait.hpp): mostly
  /// the rotation from this firing to the next, 1e-5 degrees.
  TileRow<std::int32_t> step_ticks;
  TileRow<float> sin_head, cos_head;  ///< Sine and cosine of head_cdeg.
  std::uint32_t is_dual = 0;          ///< A set bit for each firing that is one of two returns.
};

/// Wire distances of a tile, laser by laser, kTileFirings each.
struct TileDistances {
  const std::uint16_t* raw;  ///< Counts, 0 for no return.
  /// Of a sensor whose distances take more than 16 bits, by how many 1/kFinePerCount of a count
  /// each is less than `raw`, [0, kFinePerCount); null for other sensors.
  const std::uint8_t* fine = nullptr;
};
inline constexpr int kFinePerCount = 16;

/// Computes points from the distances of one sensor; holds its calibration, mount and firing times.
/// Has memory for one tile at a time; one thread.
class TileReader {
 public:
  virtual ~TileReader() = default;

  /// Opens a tile for compute_points(). `distances` must stay valid until another tile is opened.
  virtual void open(const TileHeads& heads,
                    const TileDistances& distances) noexcept TERRACUT_NONBLOCKING = 0;
  virtual void compute_points(std::size_t laser,
                              const PointsOut& out) noexcept TERRACUT_NONBLOCKING = 0;
  /// Returns the range image row of each laser.
  [[nodiscard]] virtual std::span<const std::int32_t> rows() const noexcept
      TERRACUT_NONBLOCKING = 0;

 protected:
  TileReader() = default;
  TileReader(const TileReader&) = default;
  TileReader& operator=(const TileReader&) = default;
};

}  // namespace terracut::frame
