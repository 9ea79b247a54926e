// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

namespace terracut::fuzz {

inline void check(bool holds) {
  if (!holds) std::abort();
}

/// Reads `text` as a unit's table: `parse(text, name)` returns the table or an error,
/// `text_of(table)` the text to write. The outcome is an error that names the file in printable
/// words, or a table that validates and survives being written and read.
template <class Parse, class TextOf>
void check_csv_text(const std::string& text, const Parse& parse, const TextOf& text_of) {
  const auto parsed = parse(text, "fuzz");
  if (!parsed) {
    const std::string& message = parsed.error().message;
    check(message.find("fuzz") != std::string::npos);
    check(std::all_of(message.begin(), message.end(), [](char c) { return c >= ' ' && c <= '~'; }));
    return;
  }
  check(validate(*parsed).has_value());
  const std::string written = text_of(*parsed);
  const auto again = parse(written, "again");
  check(again.has_value() && fingerprint(*again) == fingerprint(*parsed));
  check(text_of(*again) == written);
}

/// Checks any bytes at all, and the text of a good table with any bytes over it: first where to
/// write (two bytes) and how much (one), then what.
template <class Table, class Parse, class TextOf>
void check_csv(const std::uint8_t* data, std::size_t size, const Table& good, const Parse& parse,
               const TextOf& text_of) {
  check_csv_text(std::string(data, data + size), parse, text_of);
  std::string text = text_of(good);
  for (std::size_t i = 0; i + 3 <= size;) {
    const std::size_t at = (data[i] * std::size_t{256} + data[i + 1]) % text.size();
    const std::size_t count = std::min({std::size_t{data[i + 2]}, size - i - 3, text.size() - at});
    std::copy_n(data + i + 3, count, text.begin() + static_cast<std::ptrdiff_t>(at));
    i += 3 + count;
  }
  check_csv_text(text, parse, text_of);
}

}  // namespace terracut::fuzz
