// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include "commands.hpp"
#include "configuration_text.hpp"
#include "console.hpp"
#include "input_check.hpp"

namespace terracut::cli {

/// The configuration in force, checked when it was read and that its files are there, or what a
/// file could say.
ExitCode run(const ConfigOptions& options) {
  if (options.print_table) {
    fmt::print("{}", configuration_table());
  } else if (options.print_default) {
    fmt::print("{}", configuration_yaml({}));
  } else {
    const Status inputs = check_inputs(options.configuration->live);
    if (!inputs) return refuse(inputs.error());
    fmt::print("{}", configuration_yaml(*options.configuration));
  }
  return kOk;
}

}  // namespace terracut::cli
