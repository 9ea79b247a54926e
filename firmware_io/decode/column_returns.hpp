// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace terracut::decode {

/// The returns of one column, by laser, as a sensor trait computes them for the decoder: structure
/// of arrays, vehicle frame. Lasers without a return (raw == 0) carry meaningless coordinates.
template <std::size_t kLasers>
struct ColumnReturns {
  alignas(64) std::array<float, kLasers> x_m;
  alignas(64) std::array<float, kLasers> y_m;
  alignas(64) std::array<float, kLasers> z_m;
  alignas(64) std::array<float, kLasers> ground_range_m;
  alignas(64) std::array<std::int32_t, kLasers> column;        ///< Of the range image.
  alignas(64) std::array<std::int32_t, kLasers> frame_offset;  ///< Beam's - head's frame, -1..1.
  alignas(64) std::array<std::uint16_t, kLasers> raw;          ///< Wire distance; 0 = no return.
  alignas(64) std::array<std::uint8_t, kLasers> intensity;
};

}  // namespace terracut::decode
