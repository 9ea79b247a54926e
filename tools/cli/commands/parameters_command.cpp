// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <string>

#include "pipeline/ground/parameter_table.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/settings/parameter_text.hpp"
#include "tools/research/baselines/parameter_table.hpp"

namespace terracut::cli {

/// Prints docs/reference/parameters.md in Markdown from the table that the program itself reads.
ExitCode run_parameters(const Options&) {
  print_out("| key | unit | range | terracut | paper | what it is |\n|---|---|---|---|---|---|\n");
  const auto print_row = [](const auto& parameter, const std::string& terracut,
                            const std::string& paper) {
    print_out("| `{}` | {} | {} | {} | {} | {} |\n", parameter.key, parameter.unit,
              range_text(parameter), terracut, paper, parameter.help);
  };
  // Shows only the parameters that a profile reads.
  const auto value_in = [](const ground::Parameter& parameter,
                           const ground::SegmenterConfig& profile) {
    return ground::is_read(parameter, profile) ? shown_value(parameter, parameter.get(profile))
                                               : std::string();
  };
  for (const ground::Parameter& parameter : ground::parameters()) {
    print_row(parameter, value_in(parameter, ground::terracut_profile()),
              value_in(parameter, ground::paper_profile()));
  }
  for (const auto& parameter : baselines::parameters()) {
    const std::string value = shown_value(parameter, parameter.get(baselines::MethodConfig{}));
    print_row(parameter, value, value);
  }
  return kOk;
}

}  // namespace terracut::cli
