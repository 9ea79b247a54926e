// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/decode/firing_tile.hpp"

#include <bit>
#include <limits>

#include "rt/vector_clones.hpp"

namespace terracut::decode {

TERRACUT_VECTOR_CLONES void measure(std::span<const std::uint16_t> raw, float metres_per_count,
                                    float* __restrict measured_m) noexcept {
  constexpr std::int32_t kNan = 0x7FC0'0000;
  const std::uint16_t* const __restrict from = raw.data();
  const std::size_t count = raw.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t counts = from[i];
    const auto bits = std::bit_cast<std::int32_t>(static_cast<float>(counts) * metres_per_count);
    measured_m[i] = std::bit_cast<float>(bits | (-std::int32_t{counts == 0} & kNan));
  }
}

TERRACUT_VECTOR_CLONES void find_columns(const std::int32_t* __restrict rotor_column,
                                         const std::int32_t* __restrict rotor_rest,
                                         const std::int32_t* __restrict advance_column,
                                         const std::int32_t* __restrict advance_rest,
                                         ColumnAngle offset,
                                         BeamColumns& __restrict found) noexcept {
  std::int32_t* const __restrict column = found.column.data();
  for (std::size_t f = 0; f < kTileFirings; ++f) {
    const std::int32_t rest = rotor_rest[f] + advance_rest[f] + offset.rest;
    column[f] = rotor_column[f] + advance_column[f] + offset.whole +
                static_cast<std::int32_t>(rest >= kRevolution_ticks) +
                static_cast<std::int32_t>(rest >= 2 * kRevolution_ticks);
  }
  const std::int32_t first = column[0];
  std::int32_t least = std::numeric_limits<std::int32_t>::max();
  std::int32_t most = std::numeric_limits<std::int32_t>::min();
  std::int32_t differ = 0;
  for (std::size_t f = 0; f < kTileFirings; ++f) {
    least = column[f] < least ? column[f] : least;
    most = column[f] > most ? column[f] : most;
    differ |= column[f] - first - static_cast<std::int32_t>(f);
  }
  found.least = least;
  found.most = most;
  found.is_one_run = differ == 0;
}

namespace {

/// Its tables passed for __restrict.
TERRACUT_VECTOR_CLONES void fill(const std::uint16_t* __restrict raw,
                                 const std::uint8_t* __restrict intensity,
                                 std::uint32_t* __restrict numbers,
                                 std::uint8_t* __restrict intensity_out,
                                 std::uint32_t* __restrict return_index) noexcept {
  for (std::size_t f = 0; f < kTileFirings; ++f) intensity_out[f] = intensity[f];
  for (std::size_t f = 0; f < kTileFirings; ++f) {
    return_index[f] = numbers[f];
    numbers[f] += raw[f] != 0 ? 1U : 0U;
  }
}

}  // namespace

void fill_cells(const TileRow<std::uint16_t>& raw, const TileRow<std::uint8_t>& intensity,
                const frame::RangeImage::Cells& cells, TileRow<std::uint32_t>& numbers) noexcept {
  fill(raw.data(), intensity.data(), numbers.data(), cells.intensity, cells.return_index);
}

}  // namespace terracut::decode
