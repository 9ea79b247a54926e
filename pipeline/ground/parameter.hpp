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

/// A limit of this value or more means no limit.
inline constexpr double kNoLimit = 1e9;

/// The description of a parameter that users see.
struct ParameterText {
  std::string_view key;   ///< "stage.name_unit"
  std::string_view unit;  ///< Unit, such as "m", "rad" or "1/m"; empty if there is none
  std::string_view help;
  double least = 0, most = 0;                 ///< Least and greatest valid value.
  std::span<const std::string_view> choices;  ///< Names of the values 0, 1, ..; empty for a number.

  /// Reads a value. Fails with kInvalidArgument, naming the key and the valid values.
  [[nodiscard]] Expected<double> value_of(std::string_view text) const;
  /// Returns `value` as text that value_of() can read.
  [[nodiscard]] std::string text_of(double value) const;
};

/// A row of the parameter table: a parameter and its field in a configuration.
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

  /// Sets the field from text. Returns the errors of value_of().
  [[nodiscard]] Status read(Config& config, std::string_view text) const {
    return value_of(text).map([&](double value) { set(config, value); });
  }
  /// Returns the field's value as text that read() can read.
  [[nodiscard]] std::string text(const Config& config) const { return text_of(get(config)); }

  Get get;
  Set set;
};

/// Returns the row with this key; null if there is none.
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

/// The key and the value of a setting "KEY=VALUE".
struct SettingParts {
  std::string_view key, value;
};
/// Splits a setting "KEY=VALUE". Fails with kInvalidArgument for any other form.
[[nodiscard]] Expected<SettingParts> parts_of_setting(std::string_view setting);

/// Returns kInvalidArgument for a key that is not in `known`; the message suggests the nearest key
/// and the keys of the same stage.
[[nodiscard]] tl::unexpected<Error> unknown_parameter(std::string_view key,
                                                      std::span<const std::string_view> known);

}  // namespace terracut::ground
