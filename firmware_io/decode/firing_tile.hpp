// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/decode/packet_azimuths.hpp"
#include "firmware_io/decode/rotor_directions.hpp"
#include "firmware_io/decode/wire_returns.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::decode {

/// Firings that are worked on together: enough to fill vectors with what one laser found, and few
/// enough that all of them stay in the cache next to the core.
inline constexpr std::size_t kTileFirings = 24;
/// One value of each firing of a tile.
template <class Value>
using TileRow = std::array<Value, kTileFirings>;

/// What one firing found, by laser.
template <std::size_t kLasers>
struct FiringReturns {
  std::span<std::uint16_t, kLasers> raw;  ///< Wire distance; 0: no return.
  std::span<std::uint8_t, kLasers> intensity;
};

/// What some firings found, in the order of arrival: as it arrives, and by laser.
template <std::size_t kLasers>
struct FiringTile {
  alignas(64) std::array<std::array<std::uint16_t, kLasers>, kTileFirings> arrived_raw;
  alignas(64) std::array<std::array<std::uint8_t, kLasers>, kTileFirings> arrived_intensity;
  alignas(64) std::array<TileRow<std::uint16_t>, kLasers> raw;
  alignas(64) std::array<TileRow<std::uint8_t>, kLasers> intensity;

  [[nodiscard]] FiringReturns<kLasers> firing(std::size_t number) noexcept {
    return {arrived_raw[number], arrived_intensity[number]};
  }
  /// Fills in what is by laser.
  void turn() noexcept {
    transpose(arrived_raw[0].data(), kTileFirings, kLasers, raw[0].data());
    transpose(arrived_intensity[0].data(), kTileFirings, kLasers, intensity[0].data());
  }
};

/// Points of one laser of a tile, vehicle frame, metres; NaN where it has no return.
struct TilePoints {
  alignas(64) TileRow<float> x_m;
  alignas(64) TileRow<float> y_m;
  alignas(64) TileRow<float> z_m;
  alignas(64) TileRow<float> ground_range_m;
};
/// Where they are to be written, kTileFirings of each.
struct PointsOut {
  float *x_m, *y_m, *z_m, *ground_range_m;
};
[[nodiscard]] inline PointsOut all_of(TilePoints& points) noexcept {
  return {points.x_m.data(), points.y_m.data(), points.z_m.data(), points.ground_range_m.data()};
}

/// Wire distances in metres; NaN for none, and so all that follows from it.
void measure(std::span<const std::uint16_t> raw, float metres_per_count,
             float* __restrict measured_m) noexcept TERRACUT_NONBLOCKING;

/// An angle as columns of the range image: a whole number of them, and what is left, in parts of a
/// column of which kRevolution_ticks make one; [0, kRevolution_ticks).
struct ColumnAngle {
  std::int32_t whole = 0, rest = 0;
};
[[nodiscard]] constexpr ColumnAngle column_angle(std::int64_t ticks, int columns) noexcept {
  const std::int64_t parts = ticks * columns;
  const std::int64_t rest = (parts % kRevolution_ticks + kRevolution_ticks) % kRevolution_ticks;
  return {static_cast<std::int32_t>((parts - rest) / kRevolution_ticks),
          static_cast<std::int32_t>(rest)};
}

/// How far the head has rotated since a firing's azimuth when each group of lasers fires.
template <std::size_t kGroups>
struct GroupAdvance {
  std::array<float, kGroups> sin{}, cos{};
  std::array<std::int32_t, kGroups> column{}, rest{};  ///< ColumnAngle

  /// `advance_ticks`: [0, 1e5].
  void set(std::size_t group, std::int32_t advance_ticks, int columns) noexcept {
    // Below a degree two terms of each series are exact to a float.
    const float a = static_cast<float>(advance_ticks) * static_cast<float>(kRadPerTick);
    const float aa = a * a;
    sin[group] = a * (1.0F - aa * (1.0F / 6.0F));
    cos[group] = 1.0F - aa * 0.5F;
    const ColumnAngle angle = column_angle(advance_ticks, columns);
    column[group] = angle.whole;
    rest[group] = angle.rest;
  }
};

/// Where the head is at each firing of a tile, and its advance. A firing's lasers fire one group
/// after the other.
template <std::size_t kGroups>
struct TileHeads {
  alignas(64) TileRow<float> sin_rotor, cos_rotor;
  alignas(64) TileRow<std::int32_t> column, rest;  ///< ColumnAngle
  /// The advance of each group.
  alignas(64) std::array<TileRow<float>, kGroups> sin_advance, cos_advance;
  alignas(64) std::array<TileRow<std::int32_t>, kGroups> advance_column, advance_rest;

  void set_head(std::size_t firing, SinCos direction, ColumnAngle angle) noexcept {
    sin_rotor[firing] = direction.sin;
    cos_rotor[firing] = direction.cos;
    column[firing] = angle.whole;
    rest[firing] = angle.rest;
  }
  void set_advance(std::size_t firing, const GroupAdvance<kGroups>& advance) noexcept {
    for (std::size_t group = 0; group < kGroups; ++group) {
      sin_advance[group][firing] = advance.sin[group];
      cos_advance[group][firing] = advance.cos[group];
      advance_column[group][firing] = advance.column[group];
      advance_rest[group][firing] = advance.rest[group];
    }
  }
};

/// The head and its advance at one laser's firings, for the loops over them.
struct LaserHeads {
  const float *sin_rotor, *cos_rotor, *sin_advance, *cos_advance;
};
template <std::size_t kGroups>
[[nodiscard]] LaserHeads heads_of_group(const TileHeads<kGroups>& heads,
                                        std::size_t group) noexcept {
  return {heads.sin_rotor.data(), heads.cos_rotor.data(), heads.sin_advance[group].data(),
          heads.cos_advance[group].data()};
}

/// Columns of one laser's beams, counted from the first column of frame 0: those of frame n begin
/// at n times the columns of a frame.
struct BeamColumns {
  alignas(64) TileRow<std::int32_t> column;
  std::int32_t least = 0, most = 0;
  bool is_one_run = false;  ///< Each firing's column is next to that of the firing before.
};

/// beam_azimuth() and column_of() (beam_azimuth.hpp) in whole numbers that vectors hold: the floors
/// of the angles of the head, its advance and the beam's offset are added, then what is left of
/// them. `advance_column`, `advance_rest`: of the laser's group.
void find_columns(const std::int32_t* __restrict rotor_column,
                  const std::int32_t* __restrict rotor_rest,
                  const std::int32_t* __restrict advance_column,
                  const std::int32_t* __restrict advance_rest, ColumnAngle offset,
                  BeamColumns& __restrict found) noexcept TERRACUT_NONBLOCKING;

/// Fills in what a laser's points leave out of a run of cells that were empty: intensities and
/// numbers. `numbers`: of each firing's next return.
void fill_cells(const TileRow<std::uint16_t>& raw, const TileRow<std::uint8_t>& intensity,
                const frame::RangeImage::Cells& cells,
                TileRow<std::uint32_t>& numbers) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::decode
