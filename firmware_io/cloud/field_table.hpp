// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
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
  /// Where the sensor stood among the points: x y z, then its quaternion w x y z. Nothing where the
  /// file says no such place, or the origin.
  std::optional<std::array<double, 7>> viewpoint;
  std::vector<std::string> names;           ///< Of the fields with one value a point.
  std::vector<std::vector<double>> values;  ///< By the same index.

  /// Nothing for a field that is not there or has several values a point.
  [[nodiscard]] std::optional<std::span<const double>> field(std::string_view name) const {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) return std::nullopt;
    return values[static_cast<std::size_t>(found - names.begin())];
  }

  /// The same with upper case taken for lower case, and without CloudCompare's `scalar_`.
  [[nodiscard]] std::optional<std::span<const double>> field_like(std::string_view name) const {
    if (const auto exact = field(name)) return exact;
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::string plain = names[i];
      std::ranges::transform(plain, plain.begin(),
                             [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
      if (std::string_view(plain).substr(plain.starts_with("scalar_") ? 7 : 0) == name) {
        return values[i];
      }
    }
    return std::nullopt;
  }
};

/// Of one field; more is no point any more.
inline constexpr std::size_t kMostFields = 64;
inline constexpr std::size_t kLongestFieldName = 64;

}  // namespace terracut::cloud
