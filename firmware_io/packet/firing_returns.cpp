// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/packet/firing_returns.hpp"

#include <limits>

#include "rt/vector_clones.hpp"

namespace terracut::packet {

TERRACUT_VECTOR_CLONES void fill_rows(std::span<const float> values,
                                      float* __restrict rows) noexcept {
  for (std::size_t i = 0; i < values.size(); ++i, rows += kTileFirings) {
    const float value = values[i];
    for (std::size_t f = 0; f < kTileFirings; ++f) rows[f] = value;
  }
}

TERRACUT_VECTOR_CLONES void fill_rows(std::span<const std::int32_t> values,
                                      std::int32_t* __restrict rows) noexcept {
  for (std::size_t i = 0; i < values.size(); ++i, rows += kTileFirings) {
    const std::int32_t value = values[i];
    for (std::size_t f = 0; f < kTileFirings; ++f) rows[f] = value;
  }
}

TERRACUT_VECTOR_CLONES void spread_rows(std::span<const float> values,
                                        const frame::TileRow<std::int32_t>& mask,
                                        float* __restrict rows) noexcept {
  const std::int32_t* const __restrict is_meant = mask.data();
  for (std::size_t i = 0; i < values.size(); ++i, rows += kTileFirings) {
    const float value = values[i];
    for (std::size_t f = 0; f < kTileFirings; ++f) rows[f] = is_meant[f] != 0 ? value : rows[f];
  }
}

TERRACUT_VECTOR_CLONES void spread_rows(std::span<const std::int32_t> values,
                                        const frame::TileRow<std::int32_t>& mask,
                                        std::int32_t* __restrict rows) noexcept {
  const std::int32_t* const __restrict is_meant = mask.data();
  for (std::size_t i = 0; i < values.size(); ++i, rows += kTileFirings) {
    const std::int32_t value = values[i];
    for (std::size_t f = 0; f < kTileFirings; ++f) rows[f] = is_meant[f] != 0 ? value : rows[f];
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

}  // namespace terracut::packet
