// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "nearest_word.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace terracut::rt {
namespace {

/// Returns the optimal string alignment distance: Levenshtein's, but swapping two neighbours counts
/// as one edit.
std::size_t edits_between(std::string_view from, std::string_view to) {
  std::vector<std::size_t> before_last, last(to.size() + 1), row(to.size() + 1);
  for (std::size_t j = 0; j <= to.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= from.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
      row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
      const bool swapped = i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = row;
  }
  return last.back();
}

}  // namespace

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> words) {
  std::string_view nearest;
  std::size_t fewest = 2 + word.size() / 4;
  for (const std::string_view candidate : words) {
    const bool begun = !word.empty() && candidate.starts_with(word);
    const std::size_t edits = begun ? 1 : edits_between(word, candidate);
    if (edits >= fewest) continue;
    fewest = edits;
    nearest = candidate;
  }
  return nearest;
}

}  // namespace terracut::rt
