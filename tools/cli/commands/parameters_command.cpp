// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/settings/parameter_text.hpp"

namespace terracut::cli {

/// The table of docs/reference/parameters.md, in Markdown, from the table the program itself reads.
ExitCode run_parameters(const Options&) {
  const ground::MethodConfig terracut = ground::terracut_profile();
  const ground::MethodConfig paper = ground::paper_profile();
  print_out("| key | unit | range | terracut | paper | what it is |\n|---|---|---|---|---|---|\n");
  for (const auto part : {ground::parameters(), ground::baseline_parameters()}) {
    for (const ground::Parameter& parameter : part) {
      print_out("| `{}` | {} | {} | {} | {} | {} |\n", parameter.key, parameter.unit,
                range_text(parameter), shown_value(parameter, terracut),
                shown_value(parameter, paper), parameter.help);
    }
  }
  return kOk;
}

}  // namespace terracut::cli
