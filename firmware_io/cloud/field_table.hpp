// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace terracut::cloud {

/// The points of a cloud file whose fields have names, by field. A value a point and field,
/// whatever its type in the file.
struct FieldTable {
  std::size_t points = 0;
  /// Of an organised cloud, whose points stand row after row, as many in each; 1: not organised.
  std::size_t rows = 1;
  std::vector<std::string> names;           ///< Of the fields with one value a point.
  std::vector<std::vector<double>> values;  ///< By the same index.

  /// Nothing for a field that is not there or has several values a point.
  [[nodiscard]] std::optional<std::span<const double>> field(std::string_view name) const {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) return std::nullopt;
    return values[static_cast<std::size_t>(found - names.begin())];
  }
};

/// Of one field; more is no point any more.
inline constexpr std::size_t kMostFields = 64;
inline constexpr std::size_t kLongestFieldName = 64;

}  // namespace terracut::cloud
