// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/text/text_lines.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "calib/text/number_text.hpp"

namespace terracut::text {
namespace {

constexpr std::string_view kSpace = " \t\r";

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kMost = 40;
  std::string shown(text.substr(0, kMost));
  std::replace_if(shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return fmt::format("\"{}\"{}", shown, text.size() > kMost ? " ..." : "");
}

TextLines::TextLines(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  rest_ = last == std::string_view::npos ? std::string_view() : text.substr(0, last + 1);
  count_ = rest_.empty() ? 0 : line_of(rest_, rest_.size());
}

std::string_view TextLines::next() {
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  return trimmed(line);
}

void put_thousandths(fmt::memory_buffer& text, std::int64_t thousandths) {
  fmt::format_to(std::back_inserter(text), "{}{}.{:03}", thousandths < 0 ? "-" : "",
                 std::abs(thousandths) / 1000, std::abs(thousandths) % 1000);
}

}  // namespace terracut::text
