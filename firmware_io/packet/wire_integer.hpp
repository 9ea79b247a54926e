// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace terracut::packet {

/// An integer as sent in a packet, stored as bytes. Its alignment is 1, so structs of such integers
/// have no padding and may be copied to and from any address.
template <class Unsigned, std::endian kOrder>
struct WireInteger {
  std::array<std::uint8_t, sizeof(Unsigned)> bytes;

  [[nodiscard]] constexpr Unsigned value() const noexcept {
    Unsigned value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      value = static_cast<Unsigned>(value | Unsigned{bytes[i]} << shift(i));
    }
    return value;
  }
  [[nodiscard]] static constexpr WireInteger of(Unsigned value) noexcept {
    WireInteger written{};
    for (std::size_t i = 0; i < written.bytes.size(); ++i) {
      written.bytes[i] = static_cast<std::uint8_t>(value >> shift(i) & 0xFF);
    }
    return written;
  }

  constexpr WireInteger& operator=(Unsigned value) noexcept { return *this = of(value); }

 private:
  [[nodiscard]] static constexpr std::size_t shift(std::size_t i) noexcept {
    return 8 * (kOrder == std::endian::little ? i : sizeof(Unsigned) - 1 - i);
  }
};

using Le16 = WireInteger<std::uint16_t, std::endian::little>;
using Le32 = WireInteger<std::uint32_t, std::endian::little>;
using Be16 = WireInteger<std::uint16_t, std::endian::big>;

}  // namespace terracut::packet
