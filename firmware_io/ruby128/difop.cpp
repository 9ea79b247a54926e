// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/ruby128/difop.hpp"

#include <algorithm>
#include <cstring>

namespace terracut::ruby128 {

bool is_difop(std::span<const std::uint8_t> payload) noexcept {
  return payload.size() == kRubyPacketBytes &&
         std::equal(kDifopMagic.begin(), kDifopMagic.end(), payload.begin());
}

std::optional<ruby128_wire::Difop> read_difop(std::span<const std::uint8_t> payload) noexcept {
  if (!is_difop(payload)) return std::nullopt;
  ruby128_wire::Difop difop;
  std::memcpy(&difop, payload.data(), sizeof(difop));
  return difop;
}

ruby128_wire::Difop blank_difop() noexcept {
  constexpr ruby128_wire::Angle kNoAngle{kDifopUnset, {{0xFF, 0xFF}}};
  ruby128_wire::Difop difop{};
  difop.magic = kDifopMagic;
  difop.elevations.fill(kNoAngle);
  difop.azimuth_offsets.fill(kNoAngle);
  difop.tail = kDifopTail;
  return difop;
}

std::span<const std::uint8_t, kRubyPacketBytes> payload_of(
    const ruby128_wire::Difop& difop) noexcept {
  return std::span<const std::uint8_t, kRubyPacketBytes>(
      reinterpret_cast<const std::uint8_t*>(&difop), kRubyPacketBytes);
}

std::string_view sync_mode_name(std::uint8_t sync_mode) noexcept {
  constexpr std::array<std::string_view, 4> kNames{"GPS", "PTP E2E", "PTP P2P", "gPTP"};
  return sync_mode < kNames.size() ? kNames[sync_mode] : "unknown";
}

}  // namespace terracut::ruby128
