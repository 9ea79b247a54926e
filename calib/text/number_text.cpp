// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/text/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

namespace terracut::text {

std::optional<double> number_from(std::string_view text) noexcept {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(kSpace) - first + 1);
  // YAML writes infinity and NaN with a dot; std::from_chars reads only the words without it.
  if (text == ".inf" || text == "+.inf") return std::numeric_limits<double>::infinity();
  if (text == "-.inf") return -std::numeric_limits<double>::infinity();
  if (text == ".nan" || text == ".NaN") return std::numeric_limits<double>::quiet_NaN();
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range) return std::numeric_limits<double>::infinity();
  if (error != std::errc{}) return std::nullopt;
  return value;
}

std::optional<double> number_from(std::string_view text, int exponent) {
  const auto plain = number_from(text);
  if (!plain || exponent == 0 || !(std::abs(*plain) < std::numeric_limits<double>::infinity())) {
    return plain;
  }
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  text = text.substr(0, last + 1);
  const std::size_t e = text.find_first_of("eE");
  if (e != std::string_view::npos) {
    std::string_view written = text.substr(e + 1);
    if (written.starts_with('+')) written.remove_prefix(1);
    int own = 0;
    // number_from() has accepted the text, so only a huge exponent can fail here.
    const auto [end, error] = std::from_chars(written.data(), written.data() + written.size(), own);
    if (error != std::errc{} || std::abs(own) > 9999) return plain;
    exponent += own;
    text = text.substr(0, e);
  }
  return number_from(fmt::format("{}e{}", text, exponent));
}

std::string text_of(double value, int exponent) {
  std::string digits;
  for (int precision = 0; precision <= 16; ++precision) {
    digits = fmt::format("{:.{}e}", value, precision);
    if (number_from(digits) == value) break;
  }
  const auto scaled = number_from(digits, -exponent);
  const std::string plain = fmt::format("{}", scaled.value_or(value));
  if (number_from(plain, exponent) == value) return plain;
  const std::size_t e = digits.find('e');
  const auto own = number_from(digits.substr(e + 1));
  return fmt::format("{}e{}", digits.substr(0, e), static_cast<int>(own.value_or(0)) - exponent);
}

int line_of(std::string_view text, std::size_t offset) noexcept {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size()));
  return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

}  // namespace terracut::text
