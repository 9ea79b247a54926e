// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "html.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace terracut::evaluation::report {

std::string escaped(std::string_view text) {
  std::string html;
  html.reserve(text.size());
  for (const char character : text) {
    switch (character) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += character;
    }
  }
  return html;
}

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    const auto at = [&](std::size_t k) {
      return k < left ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0U;
    };
    const std::uint32_t triple = at(0) << 16 | at(1) << 8 | at(2);
    for (std::size_t digit = 0; digit < 4; ++digit) {
      text += digit <= left ? kDigits[triple >> (18 - 6 * digit) & 63U] : '=';
    }
  }
  return text;
}

std::string png_element(std::span<const std::byte> png, int width, int height,
                        std::string_view alternative) {
  return fmt::format(R"(<img src="data:image/png;base64,{}" width="{}" height="{}" alt="{}">)",
                     base64(png), width, height, escaped(alternative));
}

}  // namespace terracut::evaluation::report
