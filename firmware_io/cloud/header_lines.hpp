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

/// A file that begins with lines of text, read from its beginning.
struct HeaderLines {
  std::string_view rest;   ///< Not read yet.
  std::size_t number = 0;  ///< Of the line read last, from 1.

  /// What stands in it, without the byte order mark.
  explicit HeaderLines(std::string_view content) : rest(without_byte_order_mark(content)) {}

  /// Without its end; empty behind the last.
  [[nodiscard]] std::string_view next() noexcept {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    ++number;
    return line;
  }

  /// Whether there is another line with words in it that is no comment. `words`: its first ones.
  [[nodiscard]] bool next_words(std::size_t most, std::vector<std::string_view>& words) {
    words.clear();
    while (words.empty() && !rest.empty()) {
      split_words(next(), most, words);
      if (!words.empty() && words.front().starts_with('#')) words.clear();
    }
    return !words.empty();
  }
};

/// More words has no line of a header.
inline constexpr std::size_t kMostHeaderWords = kMostFields + 2;

}  // namespace terracut::cloud
