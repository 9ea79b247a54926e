// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "parameter_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace terracut::cli {
namespace {

constexpr double kNoLimit = 1e9;  // pipeline/ground/parameter_table.cpp's "no limit"

std::string limit(double value) {
  return value >= kNoLimit ? "no limit" : fmt::format("{}", static_cast<float>(value));
}

}  // namespace

std::string range_text(const ground::Parameter& parameter) {
  if (!parameter.choices.empty()) return fmt::format("{}", fmt::join(parameter.choices, ", "));
  return fmt::format("{} .. {}", limit(parameter.least), limit(parameter.most));
}

std::string shown_value(const ground::Parameter& parameter, const ground::MethodConfig& config) {
  const bool unlimited = parameter.choices.empty() && parameter.get(config) >= kNoLimit;
  return unlimited ? "no limit" : ground::value_text(parameter, config);
}

}  // namespace terracut::cli
