// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "counts_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace terracut::cli {

std::string printable(std::string_view text) {
  std::string result(text);
  std::ranges::replace_if(result, [](char c) { return c < ' ' || c > '~'; }, '?');
  return result;
}

std::string counts_text(std::span<const rt::NamedCount> counts) {
  std::string text;
  for (const rt::NamedCount& counted : counts) {
    if (counted.count == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", printable(counted.name.view()),
                        counted.count);
  }
  return text;
}

}  // namespace terracut::cli
