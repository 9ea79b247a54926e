// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>

namespace terracut::decode {

/// Big-endian integers made of bytes: alignment 1, so structs of them have no padding and may be
/// copied to and from any address.
struct Be16 {
  std::array<std::uint8_t, 2> bytes;
  [[nodiscard]] constexpr std::uint16_t value() const noexcept {
    return static_cast<std::uint16_t>(bytes[0] << 8 | bytes[1]);
  }
  [[nodiscard]] static constexpr Be16 of(std::uint16_t value) noexcept {
    return {{static_cast<std::uint8_t>(value >> 8), static_cast<std::uint8_t>(value & 0xFF)}};
  }
};

struct Be32 {
  std::array<std::uint8_t, 4> bytes;
  [[nodiscard]] constexpr std::uint32_t value() const noexcept {
    return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 |
           std::uint32_t{bytes[2]} << 8 | std::uint32_t{bytes[3]};
  }
  [[nodiscard]] static constexpr Be32 of(std::uint32_t value) noexcept {
    return {{static_cast<std::uint8_t>(value >> 24), static_cast<std::uint8_t>(value >> 16 & 0xFF),
             static_cast<std::uint8_t>(value >> 8 & 0xFF),
             static_cast<std::uint8_t>(value & 0xFF)}};
  }
};

}  // namespace terracut::decode
