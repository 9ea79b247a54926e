// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace terracut::cloud {

/// A file that begins with lines of text, read from its beginning.
struct HeaderLines {
  std::string_view rest;   ///< Not read yet.
  std::size_t number = 0;  ///< Of the line read last, from 1.

  /// Without its end; empty behind the last.
  [[nodiscard]] std::string_view next() noexcept {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    ++number;
    return line;
  }
};

}  // namespace terracut::cloud
