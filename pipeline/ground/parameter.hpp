// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rt/error.hpp"

namespace terracut::ground {

/// A limit of a parameter from this value on means no limit.
inline constexpr double kNoLimit = 1e9;

/// The parts of a parameter that users see.
struct ParameterText {
  std::string_view key;   ///< "stage.name_unit"
  std::string_view unit;  ///< "m", "rad", "1/m", ... or empty
  std::string_view help;
  double least = 0, most = 0;                 ///< Valid range, ends included.
  std::span<const std::string_view> choices;  ///< Names of the values 0, 1, ..; empty for a number.

  /// Reads a value. kInvalidArgument, naming the key and the valid values.
  [[nodiscard]] Expected<double> value_of(std::string_view text) const;
  /// Returns the text of a value for value_of().
  [[nodiscard]] std::string text_of(double value) const;
};

/// A parameter with its field of a configuration: a row of a table.
template <class Config>
struct ParameterOf : ParameterText {
  using Get = double (*)(const Config&) noexcept;
  using Set = void (*)(Config&, double) noexcept;

  constexpr ParameterOf(std::string_view its_key, std::string_view its_unit,
                        std::string_view its_help, double its_least, double its_most,
                        std::span<const std::string_view> its_choices, Get its_get, Set its_set)
      : ParameterText{its_key, its_unit, its_help, its_least, its_most, its_choices},
        get(its_get),
        set(its_set) {}

  /// Sets the field from text. Errors of value_of().
  [[nodiscard]] Status read(Config& config, std::string_view text) const {
    return value_of(text).map([&](double value) { set(config, value); });
  }
  /// Returns the text of the field's value for read().
  [[nodiscard]] std::string text(const Config& config) const { return text_of(get(config)); }

  Get get;
  Set set;
};

/// Returns the row of that key; null if there is none.
template <class Config>
[[nodiscard]] const ParameterOf<Config>* find_parameter(std::span<const ParameterOf<Config>> table,
                                                        std::string_view key) noexcept {
  const auto found = std::ranges::find(table, key, &ParameterOf<Config>::key);
  return found == table.end() ? nullptr : &*found;
}

template <class Config>
[[nodiscard]] std::vector<std::string_view> keys_of(std::span<const ParameterOf<Config>> table) {
  std::vector<std::string_view> keys;
  for (const ParameterOf<Config>& row : table) keys.push_back(row.key);
  return keys;
}

/// The parts of "KEY=VALUE".
struct SettingParts {
  std::string_view key, value;
};
/// Splits a setting. kInvalidArgument for anything else.
[[nodiscard]] Expected<SettingParts> parts_of_setting(std::string_view setting);

/// Returns kInvalidArgument for a key not among `known`, suggesting the nearest and those of the
/// same stage.
[[nodiscard]] tl::unexpected<Error> unknown_parameter(std::string_view key,
                                                      std::span<const std::string_view> known);

}  // namespace terracut::ground
