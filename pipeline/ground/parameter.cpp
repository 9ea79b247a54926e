// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/parameter.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rt/nearest_word.hpp"
#include "rt/number_of.hpp"

namespace terracut::ground {
namespace {

std::string number_text(double value) {
  // Fields are float: returns the shortest text that reads back as the same float.
  return fmt::format("{}", static_cast<float>(value));
}

}  // namespace

Expected<double> ParameterText::value_of(std::string_view text) const {
  if (!choices.empty()) {
    const auto choice = std::ranges::find(choices, text);
    if (choice != choices.end()) return static_cast<double>(choice - choices.begin());
    return fail(ErrorCode::kInvalidArgument, fmt::format("{}: expected one of {}, found '{}'", key,
                                                         fmt::join(choices, ", "), text));
  }
  const auto number = rt::number_of<double>(text);
  if (number && *number >= least && *number <= most) return *number;
  return fail(
      ErrorCode::kInvalidArgument,
      fmt::format("{}: expected a number from {} to {}{}{}, found '{}'", key, number_text(least),
                  number_text(most), unit.empty() ? "" : " ", unit, text));
}

std::string ParameterText::text_of(double value) const {
  return choices.empty() ? number_text(value)
                         : std::string(choices[static_cast<std::size_t>(value)]);
}

Expected<SettingParts> parts_of_setting(std::string_view setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string_view::npos) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("expected KEY=VALUE, found '{}'", setting));
  }
  return SettingParts{setting.substr(0, equals), setting.substr(equals + 1)};
}

tl::unexpected<Error> unknown_parameter(std::string_view key,
                                        std::span<const std::string_view> known) {
  const std::string_view stage = key.substr(0, key.find('.') + 1);
  std::vector<std::string_view> alike;
  for (const std::string_view other : known) {
    if (!stage.empty() && other.starts_with(stage)) alike.push_back(other);
  }
  const std::string_view meant = rt::nearest_word(key, known);
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("no parameter is called '{}'{}; {}", key,
                          meant.empty() ? "" : fmt::format(" (did you mean {}?)", meant),
                          alike.empty() ? "docs/reference/parameters.md lists them all"
                                        : fmt::format("there are {}", fmt::join(alike, ", "))));
}

}  // namespace terracut::ground
