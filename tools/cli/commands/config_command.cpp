// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/input/input_check.hpp"
#include "tools/cli/settings/configuration_text.hpp"

namespace terracut::cli {

/// Prints the configuration in force, or a file to start from. Values were checked when they were
/// read; the files that they name are checked here.
ExitCode run_config(const Options& options) {
  if (options.print_table) {
    print_text(configuration_table());
  } else if (options.print_default) {
    const Options defaults;
    print_text(configuration_yaml(defaults));
  } else {
    const Status inputs = check_inputs(options);
    if (!inputs) return refuse(inputs.error());
    print_text(configuration_yaml(options));
  }
  return kOk;
}

}  // namespace terracut::cli
