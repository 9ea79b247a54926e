// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "pipeline/parameter_table.hpp"

namespace terracut::cli {
namespace {

constexpr double kNoLimit = 1e9;  // pipeline/parameter_table.cpp's "no limit"

std::string limit(double value) {
  return value >= kNoLimit ? "no limit" : fmt::format("{}", static_cast<float>(value));
}

std::string range(const pipeline::Parameter& parameter) {
  if (!parameter.choices.empty()) return fmt::format("{}", fmt::join(parameter.choices, ", "));
  return fmt::format("{} .. {}", limit(parameter.least), limit(parameter.most));
}

std::string value(const pipeline::Parameter& parameter, const pipeline::MethodConfig& config) {
  const bool unlimited = parameter.choices.empty() && parameter.get(config) >= kNoLimit;
  return unlimited ? "no limit" : pipeline::value_text(parameter, config);
}

}  // namespace

/// The table of docs/parameters.md, in Markdown, from the table the program itself reads.
ExitCode run(const ParametersOptions&) {
  const pipeline::MethodConfig terracut = pipeline::terracut_profile();
  const pipeline::MethodConfig paper = pipeline::paper_profile();
  fmt::print("| key | unit | range | terracut | paper | what it is |\n|---|---|---|---|---|---|\n");
  for (const pipeline::Parameter& parameter : pipeline::parameters()) {
    fmt::print("| `{}` | {} | {} | {} | {} | {} |\n", parameter.key, parameter.unit,
               range(parameter), value(parameter, terracut), value(parameter, paper),
               parameter.help);
  }
  return kOk;
}

}  // namespace terracut::cli
