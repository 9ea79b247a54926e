// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware_io/frame/firing_tile.hpp"
#include "firmware_io/frame/transpose.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/packet/rotor_directions.hpp"
#include "firmware_io/packet/wire_returns.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::packet {

using frame::BeamColumns;
using frame::kTileFirings;
using frame::PointsOut;
using frame::TilePoints;
using frame::TileRow;

/// The returns of one firing, indexed by laser.
template <std::size_t kLasers>
struct FiringReturns {
  std::span<std::uint16_t, kLasers> raw;  ///< Distance as sent, in counts; 0: no return.
  std::span<std::uint8_t, kLasers> intensity;
  std::span<std::uint8_t> fine{};  ///< See frame::TileDistances; empty for most sensors.
};

/// The returns of kTileFirings firings, first stored as they arrive, then sorted by laser by
/// turn(). `kHasFine` says whether there are fine distances.
template <std::size_t kLasers, bool kHasFine = false>
struct FiringTile {
  static constexpr std::size_t kFine = kHasFine ? kLasers : 0;

  alignas(64) std::array<std::array<std::uint16_t, kLasers>, kTileFirings> arrived_raw;
  alignas(64) std::array<std::array<std::uint8_t, kLasers>, kTileFirings> arrived_intensity;
  alignas(64) std::array<TileRow<std::uint16_t>, kLasers> raw;
  alignas(64) std::array<TileRow<std::uint8_t>, kLasers> intensity;
  alignas(64) std::array<std::array<std::uint8_t, kFine>, kTileFirings> arrived_fine;
  alignas(64) std::array<TileRow<std::uint8_t>, kFine> fine;

  [[nodiscard]] FiringReturns<kLasers> firing(std::size_t number) noexcept {
    return {arrived_raw[number], arrived_intensity[number], arrived_fine[number]};
  }
  [[nodiscard]] frame::TileDistances distances() const noexcept {
    return {raw[0].data(), kHasFine ? fine.data()->data() : nullptr};
  }
  /// Sorts the returns that have arrived by laser, by a transposition.
  void turn() noexcept {
    frame::transpose(arrived_raw[0].data(), kTileFirings, kLasers, raw[0].data());
    frame::transpose(arrived_intensity[0].data(), kTileFirings, kLasers, intensity[0].data());
    if constexpr (kHasFine) {
      frame::transpose(arrived_fine[0].data(), kTileFirings, kLasers, fine[0].data());
    }
  }
};

/// Converts wire distances of one laser to metres. No return becomes NaN, and so does everything
/// computed from it.
inline void measure(const std::uint16_t* __restrict raw, float metres_per_count,
                    float* __restrict measured_m) noexcept {
  constexpr std::int32_t kNan = 0x7FC0'0000;
  for (std::size_t f = 0; f < kTileFirings; ++f) {
    const std::int32_t counts = raw[f];
    const auto bits = std::bit_cast<std::int32_t>(static_cast<float>(counts) * metres_per_count);
    measured_m[f] = std::bit_cast<float>(bits | (-std::int32_t{counts == 0} & kNan));
  }
}

/// The same for distances with fine parts (frame::TileDistances).
inline void measure(const std::uint16_t* __restrict raw, const std::uint8_t* __restrict fine,
                    float metres_per_count, float* __restrict measured_m) noexcept {
  constexpr std::int32_t kNan = 0x7FC0'0000;
  const float metres_per_fine = metres_per_count / frame::kFinePerCount;
  for (std::size_t f = 0; f < kTileFirings; ++f) {
    const std::int32_t counts = raw[f];
    const std::int32_t fine_counts = counts * frame::kFinePerCount - fine[f];
    const auto bits =
        std::bit_cast<std::int32_t>(static_cast<float>(fine_counts) * metres_per_fine);
    measured_m[f] = std::bit_cast<float>(bits | (-std::int32_t{counts == 0} & kNan));
  }
}

/// An angle measured in columns of the range image: whole columns, and the rest in parts of a
/// column, [0, kRevolution_ticks). A column has kRevolution_ticks parts.
struct ColumnAngle {
  std::int32_t whole = 0, rest = 0;
};
[[nodiscard]] constexpr ColumnAngle column_angle(std::int64_t ticks, int columns) noexcept {
  const std::int64_t parts = ticks * columns;
  const std::int64_t rest = (parts % kRevolution_ticks + kRevolution_ticks) % kRevolution_ticks;
  return {static_cast<std::int32_t>((parts - rest) / kRevolution_ticks),
          static_cast<std::int32_t>(rest)};
}

/// Returns sine and cosine of an angle in [0, 1e5] ticks. This is at most a degree, for which two
/// terms of each series are exact in float.
[[nodiscard]] constexpr SinCos small_advance(std::int32_t ticks) noexcept {
  const float a = static_cast<float>(ticks) * static_cast<float>(kRadPerTick);
  const float aa = a * a;
  return {a * (1.0F - aa * (1.0F / 6.0F)), 1.0F - aa * 0.5F};
}

/// The head's direction at each firing of a tile, and how far it advances until each group of
/// lasers fires.
template <std::size_t kGroups>
struct GroupHeads {
  alignas(64) TileRow<float> sin_rotor, cos_rotor;
  alignas(64) std::array<TileRow<float>, kGroups> sin_advance, cos_advance;
};

/// Fills row i with values[i]; `rows` holds the rows one after the other.
void fill_rows(std::span<const float> values, float* rows) noexcept TERRACUT_NONBLOCKING;
void fill_rows(std::span<const std::int32_t> values,
               std::int32_t* rows) noexcept TERRACUT_NONBLOCKING;
/// Writes values[i] into the masked firings of row i; `rows` holds the rows one after the other.
void spread_rows(std::span<const float> values, const frame::TileRow<std::int32_t>& mask,
                 float* rows) noexcept TERRACUT_NONBLOCKING;
void spread_rows(std::span<const std::int32_t> values, const frame::TileRow<std::int32_t>& mask,
                 std::int32_t* rows) noexcept TERRACUT_NONBLOCKING;

/// The head's direction and advance at each firing of one laser.
struct LaserHeads {
  const float *sin_rotor, *cos_rotor, *sin_advance, *cos_advance;
};
template <std::size_t kGroups>
[[nodiscard]] LaserHeads heads_of_group(const GroupHeads<kGroups>& heads,
                                        std::size_t group) noexcept {
  return {heads.sin_rotor.data(), heads.cos_rotor.data(), heads.sin_advance[group].data(),
          heads.cos_advance[group].data()};
}

/// Finds what beam_azimuth() and column_of() (beam_azimuth.hpp) find, but in integers small enough
/// for vectors: adds up the whole columns of head, advance and beam offset, then the rests.
/// `advance_column` and `advance_rest` are those of the laser's group.
void find_columns(const std::int32_t* __restrict rotor_column,
                  const std::int32_t* __restrict rotor_rest,
                  const std::int32_t* __restrict advance_column,
                  const std::int32_t* __restrict advance_rest, ColumnAngle offset,
                  BeamColumns& __restrict found) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::packet
