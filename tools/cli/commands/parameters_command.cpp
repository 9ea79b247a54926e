// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ground/parameter_table.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/settings/parameter_text.hpp"
#include "tools/research/baselines/parameter_table.hpp"

namespace terracut::cli {

/// Prints docs/reference/parameters.md in Markdown from the table that the program itself reads.
ExitCode run_parameters(const Options&) {
  print_out("| key | unit | range | terracut | paper | what it is |\n|---|---|---|---|---|---|\n");
  const auto print_rows = [](const auto& parameters, const auto& terracut, const auto& paper) {
    for (const auto& parameter : parameters) {
      print_out("| `{}` | {} | {} | {} | {} | {} |\n", parameter.key, parameter.unit,
                range_text(parameter), shown_value(parameter, parameter.get(terracut)),
                shown_value(parameter, parameter.get(paper)), parameter.help);
    }
  };
  print_rows(ground::parameters(), ground::terracut_profile(), ground::paper_profile());
  print_rows(baselines::parameters(), baselines::MethodConfig{}, baselines::MethodConfig{});
  return kOk;
}

}  // namespace terracut::cli
