// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <vector>

#include "firmware_io/cloud/cloud_bytes.hpp"
#include "firmware_io/cloud/field_table.hpp"

namespace terracut::cloud {

/// Reads a file that begins with lines of text.
struct HeaderLines {
  std::string_view rest;   ///< The part not read yet.
  std::size_t number = 0;  ///< Number of the line read last, from 1.

  /// Skips the byte order mark of `content`.
  explicit HeaderLines(std::string_view content) : rest(without_byte_order_mark(content)) {}

  /// Returns the next line without its end; empty after the last.
  [[nodiscard]] std::string_view next() noexcept {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    ++number;
    return line;
  }

  /// Reads the next line that has words and is no comment; false if there is none. `words` gets its
  /// first `most` words.
  [[nodiscard]] bool next_words(std::size_t most, std::vector<std::string_view>& words) {
    words.clear();
    while (words.empty() && !rest.empty()) {
      split_words(next(), most, words);
      if (!words.empty() && words.front().starts_with('#')) words.clear();
    }
    return !words.empty();
  }
};

/// No line of a header has more words.
inline constexpr std::size_t kMostHeaderWords = kMostFields + 2;

}  // namespace terracut::cloud
