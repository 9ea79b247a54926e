// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "stream_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "rt/number_of.hpp"

namespace terracut::streams {
namespace {

constexpr std::uint32_t kVlanBits = 0xFFF;

std::optional<std::uint32_t> vlan_id(std::string_view text) {
  const auto id = rt::number_of<std::uint16_t>(text);
  return id && *id < kVlanBits ? std::optional<std::uint32_t>(*id) : std::nullopt;
}

}  // namespace

std::string vlan_text(std::uint32_t vlan) {
  const std::uint32_t outer = vlan >> 12;
  return outer == 0 ? fmt::format("{}", vlan) : fmt::format("{}.{}", outer, vlan & kVlanBits);
}

Expected<std::uint32_t> parse_vlan(std::string_view text) {
  const std::size_t dot = text.find('.');
  const auto first = vlan_id(text.substr(0, dot));
  if (first && dot == std::string_view::npos) return *first;
  const auto inner = dot == std::string_view::npos ? std::nullopt : vlan_id(text.substr(dot + 1));
  if (first && inner && *first != 0 && *inner != 0) return *first << 12 | *inner;
  return fail(
      ErrorCode::kInvalidArgument,
      fmt::format("'{}' is no VLAN; expected a number to 4094, OUTER.INNER, or 0 for none", text));
}

std::string mac_text(std::uint64_t mac) {
  std::string text;
  for (int shift = 40; shift >= 0; shift -= 8) {
    text += fmt::format("{}{:02x}", text.empty() ? "" : ":", mac >> shift & 0xFF);
  }
  return text;
}

Expected<std::uint64_t> parse_mac(std::string_view text) {
  constexpr std::size_t kBytes = 6, kTextAByte = 3;
  std::uint64_t mac = 0;
  bool fits = text.size() == kBytes * kTextAByte - 1;
  for (std::size_t i = 0; fits && i < kBytes; ++i) {
    const char* const digits = text.data() + i * kTextAByte;
    std::uint8_t byte = 0;
    const auto read = std::from_chars(digits, digits + 2, byte, 16);
    fits =
        read.ec == std::errc() && read.ptr == digits + 2 && (i + 1 == kBytes || digits[2] == ':');
    mac = mac << 8 | byte;
  }
  if (fits) return mac;
  return fail(
      ErrorCode::kInvalidArgument,
      fmt::format("'{}' is no link-layer address; expected one like 60:76:88:10:23:a1", text));
}

}  // namespace terracut::streams
