// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "terminal_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace terracut::cli {
namespace {

std::uint8_t byte_at(std::string_view text, std::size_t i) {
  return static_cast<std::uint8_t>(text[i]);
}

/// Returns the length in bytes of the UTF-8 character at the start of `text`; 0 if it is invalid.
std::size_t character_bytes(std::string_view text) {
  const std::uint8_t first = byte_at(text, 0);
  if (first < 0x80) return 1;
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < bytes) return 0;
  std::uint32_t code = first & (0xFFU >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte_at(text, i) & 0xC0U) != 0x80) return 0;
    code = code << 6 | (byte_at(text, i) & 0x3FU);
  }
  constexpr std::uint32_t kLeastOf3 = 0x800, kLeastOf4 = 0x10000;
  const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
  const bool is_shortest = bytes == 2 || code >= (bytes == 3 ? kLeastOf3 : kLeastOf4);
  return code <= 0x10FFFF && is_shortest && !is_surrogate ? bytes : 0;
}

/// Returns the length in bytes of the character at the start of `text`; 0 for control characters.
std::size_t shown_bytes(std::string_view text) {
  const std::size_t bytes = character_bytes(text);
  const std::uint8_t first = byte_at(text, 0);
  const bool is_control = bytes == 1   ? first < 0x20 || first == 0x7F
                          : bytes == 2 ? first == 0xC2 && byte_at(text, 1) < 0xA0
                                       : false;
  return is_control ? 0 : bytes;
}

}  // namespace

std::string for_terminal(std::string_view text) {
  std::string shown;
  while (!text.empty()) {
    const std::size_t bytes = shown_bytes(text);
    if (bytes > 0) {
      shown += text.substr(0, bytes);
    } else {
      shown += text[0] == '\n' ? '\n' : '?';
    }
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return shown;
}

std::string line_for_terminal(std::string_view text) {
  std::string shown = for_terminal(text);
  std::ranges::replace(shown, '\n', '?');
  return shown;
}

std::string shell_word(std::string_view text) {
  std::string plain = "'", escaped = "$'";
  bool is_plain = true;
  while (!text.empty()) {
    const std::size_t bytes = shown_bytes(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(bytes, 1));
    plain += character == "'" ? "'\\''" : character;
    if (bytes == 0) {
      is_plain = false;
      escaped += fmt::format("\\x{:02x}", byte_at(text, 0));
    } else {
      if (character == "'" || character == "\\") escaped += '\\';
      escaped += character;
    }
    text.remove_prefix(character.size());
  }
  return (is_plain ? plain : escaped) + "'";
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t bytes = character_bytes(text);
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return true;
}

}  // namespace terracut::cli
