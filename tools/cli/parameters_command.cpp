// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include "commands.hpp"
#include "parameter_text.hpp"

namespace terracut::cli {

/// The table of docs/parameters.md, in Markdown, from the table the program itself reads.
ExitCode run(const ParametersOptions&) {
  const pipeline::MethodConfig terracut = pipeline::terracut_profile();
  const pipeline::MethodConfig paper = pipeline::paper_profile();
  fmt::print("| key | unit | range | terracut | paper | what it is |\n|---|---|---|---|---|---|\n");
  for (const auto part : {pipeline::parameters(), pipeline::rival_parameters()}) {
    for (const pipeline::Parameter& parameter : part) {
      fmt::print("| `{}` | {} | {} | {} | {} | {} |\n", parameter.key, parameter.unit,
                 range_text(parameter), shown_value(parameter, terracut),
                 shown_value(parameter, paper), parameter.help);
    }
  }
  return kOk;
}

}  // namespace terracut::cli
