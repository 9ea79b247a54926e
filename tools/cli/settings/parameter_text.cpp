// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "parameter_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace terracut::cli {
namespace {

std::string limit(double value) {
  return value >= ground::kNoLimit ? "no limit" : fmt::format("{}", static_cast<float>(value));
}

}  // namespace

std::string range_text(const ground::ParameterText& parameter) {
  if (!parameter.choices.empty()) return fmt::format("{}", fmt::join(parameter.choices, ", "));
  return fmt::format("{} .. {}", limit(parameter.least), limit(parameter.most));
}

std::string shown_value(const ground::ParameterText& parameter, double value) {
  const bool unlimited = parameter.choices.empty() && value >= ground::kNoLimit;
  return unlimited ? "no limit" : parameter.text_of(value);
}

}  // namespace terracut::cli
