// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rt/threads/nonblocking.hpp"

namespace terracut::packet {

/// Size of a return on the wire: two bytes of distance, one of intensity.
inline constexpr std::size_t kWireReturnBytes = 3;
enum class ByteOrder : std::uint8_t { kLittle, kBig };

/// Splits returns into distances and intensities, eight at once. `bytes` holds kWireReturnBytes for
/// each element of `raw`, whose size is a multiple of 8; as many intensities are written.
void split_returns(const std::uint8_t* bytes, ByteOrder order, std::span<std::uint16_t> raw,
                   std::uint8_t* intensity) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::packet
