// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace terracut::rt {

/// Returns `text` as a number of type Number; nothing if any part of it is something else ("3m", "
/// 3", "+3", "") or the number does not fit. Independent of the locale.
template <class Number>
[[nodiscard]] std::optional<Number> number_of(std::string_view text) noexcept {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [read_up_to, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || read_up_to != end) return std::nullopt;
  return number;
}

}  // namespace terracut::rt
