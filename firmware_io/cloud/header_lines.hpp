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

/// Reads the lines of text at the beginning of a file.
struct HeaderLines {
  std::string_view rest;   ///< The part of the file that has not been read yet.
  std::size_t number = 0;  ///< Number of the line read last, counted from 1.

  /// Begins to read `content`, after its byte order mark if it has one.
  explicit HeaderLines(std::string_view content) : rest(without_byte_order_mark(content)) {}

  /// Returns the next line without its line end; empty after the last line.
  [[nodiscard]] std::string_view next() noexcept {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    ++number;
    return line;
  }

  /// Reads the next line that has words and is no comment; false if there is none. `words` gets the
  /// first `most` words of the line.
  [[nodiscard]] bool next_words(std::size_t most, std::vector<std::string_view>& words) {
    words.clear();
    while (words.empty() && !rest.empty()) {
      split_words(next(), most, words);
      if (!words.empty() && words.front().starts_with('#')) words.clear();
    }
    return !words.empty();
  }
};

/// The most words that a line of a header may have.
inline constexpr std::size_t kMostHeaderWords = kMostFields + 2;

}  // namespace terracut::cloud
