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

/// The points of a cloud file with named fields, stored field by field: each point has one value
/// per field, whatever the field's type in the file.
struct FieldTable {
  std::size_t points = 0;
  /// The number of rows of an organised cloud, all of equal length; 1 if not organised.
  std::size_t rows = 1;
  /// The sensor's position x y z among the points, then its rotation as a quaternion w x y z.
  /// Nothing if the file states none, or the origin.
  std::optional<std::array<double, 7>> viewpoint;
  std::vector<std::string> names;           ///< The fields with one value a point.
  std::vector<std::vector<double>> values;  ///< The values of each field, in the order of `names`.

  /// Returns the values of a field; nothing if it is missing or has several values a point.
  [[nodiscard]] std::optional<std::span<const double>> field(std::string_view name) const {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) return std::nullopt;
    return values[static_cast<std::size_t>(found - names.begin())];
  }

  /// Finds the field without regard to case, underscores and CloudCompare's `scalar_`: `Laser_ID`
  /// is `laserid`, and so is `scalar_laser_id`.
  [[nodiscard]] std::optional<std::span<const double>> field_like(std::string_view name) const {
    if (const auto exact = field(name)) return exact;
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::string plain;
      for (const char c : names[i]) {
        if (c != '_') plain += c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
      }
      constexpr std::string_view kCloudCompares = "scalar";
      if (plain == name) return values[i];
      if (plain.starts_with(kCloudCompares) && plain.substr(kCloudCompares.size()) == name) {
        return values[i];
      }
    }
    return std::nullopt;
  }
};

/// The most fields accepted.
inline constexpr std::size_t kMostFields = 64;
inline constexpr std::size_t kLongestFieldName = 64;

}  // namespace terracut::cloud
