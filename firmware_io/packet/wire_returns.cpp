// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/packet/wire_returns.hpp"

#include <bit>
#include <cstring>

#include "rt/vector_clones.hpp"

namespace terracut::packet {
namespace {

static_assert(std::endian::native == std::endian::little, "lanes are stored as they lie");

using SixteenBytes = std::uint8_t __attribute__((vector_size(16)));
using EightBytes = std::uint8_t __attribute__((vector_size(8)));
}  // namespace

TERRACUT_VECTOR_CLONES void split_returns(const std::uint8_t* bytes, ByteOrder order,
                                          std::span<std::uint16_t> raw,
                                          std::uint8_t* intensity) noexcept {
  constexpr std::size_t kAtOnce = 8, kBytes = kAtOnce * kWireReturnBytes;
  std::uint16_t* to = raw.data();
  for (const std::uint16_t* const end = to + raw.size(); to < end;
       to += kAtOnce, intensity += kAtOnce, bytes += kBytes) {
    SixteenBytes first, last;  // parts of the 24 bytes; the middle ones are in both
    std::memcpy(&first, bytes, sizeof(first));
    std::memcpy(&last, bytes + kBytes - sizeof(last), sizeof(last));
    const SixteenBytes distances = order == ByteOrder::kLittle
                                       ? __builtin_shufflevector(first, last, 0, 1, 3, 4, 6, 7, 9,
                                                                 10, 12, 13, 15, 24, 26, 27, 29, 30)
                                       : __builtin_shufflevector(first, last, 1, 0, 4, 3, 7, 6, 10,
                                                                 9, 13, 12, 24, 15, 27, 26, 30, 29);
    const EightBytes strengths = __builtin_shufflevector(first, last, 2, 5, 8, 11, 14, 25, 28, 31);
    std::memcpy(to, &distances, sizeof(distances));
    std::memcpy(intensity, &strengths, sizeof(strengths));
  }
}

TERRACUT_VECTOR_CLONES void split_wide_returns(const std::uint8_t* bytes,
                                               std::span<std::uint16_t> raw,
                                               std::uint8_t* intensity) noexcept {
  constexpr std::size_t kAtOnce = 4, kBytes = kAtOnce * 4;
  using FourBytes = std::uint8_t __attribute__((vector_size(4)));
  std::uint16_t* to = raw.data();
  for (const std::uint16_t* const end = to + raw.size(); to < end;
       to += kAtOnce, intensity += kAtOnce, bytes += kBytes) {
    SixteenBytes returns;
    std::memcpy(&returns, bytes, sizeof(returns));
    const EightBytes distances =
        __builtin_shufflevector(returns, returns, 0, 1, 4, 5, 8, 9, 12, 13);
    const FourBytes strengths = __builtin_shufflevector(returns, returns, 2, 6, 10, 14);
    std::memcpy(to, &distances, sizeof(distances));
    std::memcpy(intensity, &strengths, sizeof(strengths));
  }
}

}  // namespace terracut::packet
