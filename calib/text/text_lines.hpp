// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace terracut::text {

/// Returns `text` without blanks at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);
/// Returns the beginning of a line in printable form.
[[nodiscard]] std::string quoted(std::string_view text);
/// Appends a number of thousandths with three decimals: -290 as "-0.290".
void put_thousandths(fmt::memory_buffer& text, std::int64_t thousandths);

/// Splits text into lines, without a byte order mark and the blank lines at its end.
class TextLines {
 public:
  explicit TextLines(std::string_view text);
  [[nodiscard]] int count() const { return count_; }

  /// Returns the next line, trimmed; empty after the last one.
  std::string_view next();

 private:
  std::string_view rest_;
  int count_ = 0;
};

}  // namespace terracut::text
