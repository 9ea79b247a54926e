// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rt/threads/nonblocking.hpp"

namespace terracut::packet {

/// Bytes of a return as sent: two of distance, one of intensity.
inline constexpr std::size_t kWireReturnBytes = 3;
enum class ByteOrder : std::uint8_t { kLittle, kBig };

/// Splits returns into distances and intensities, eight at a time. `bytes` has kWireReturnBytes for
/// each element of `raw`, whose size is a multiple of 8; the same number of intensities is written.
void split_returns(const std::uint8_t* bytes, ByteOrder order, std::span<std::uint16_t> raw,
                   std::uint8_t* intensity) noexcept TERRACUT_NONBLOCKING;
/// The same for returns of four bytes with the distance in little-endian order; the last byte of
/// each is left out.
void split_wide_returns(const std::uint8_t* bytes, std::span<std::uint16_t> raw,
                        std::uint8_t* intensity) noexcept TERRACUT_NONBLOCKING;

}  // namespace terracut::packet
