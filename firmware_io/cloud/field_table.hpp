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

  /// The same with upper case taken for lower case, and without underscores and CloudCompare's
  /// `scalar_`: `Laser_ID` is `laserid`, and so is `scalar_laser_id`.
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

/// Of one field; more is no point any more.
inline constexpr std::size_t kMostFields = 64;
inline constexpr std::size_t kLongestFieldName = 64;

}  // namespace terracut::cloud
