// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include "commands.hpp"
#include "configuration_text.hpp"

namespace terracut::cli {

/// The configuration in force, checked when it was read, or what a file could say.
ExitCode run(const ConfigOptions& options) {
  if (options.print_table) {
    fmt::print("{}", configuration_table());
  } else {
    fmt::print(
        "{}", configuration_yaml(options.print_default ? Configuration{} : *options.configuration));
  }
  return kOk;
}

}  // namespace terracut::cli
