// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rt/error.hpp"
#include "tools/cli/command.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// What the program was asked to do.
struct Arguments {
  std::optional<Command> command;  ///< None: `text` is to be printed, help or the version.
  std::string text;
  Options options;  ///< The defaults, the file over them, what was typed over it.
  std::filesystem::path configuration;  ///< The file of --config; empty: none.
};

/// Reads the command line and the configuration file that it names. kInvalidArgument, naming
/// command and option, for a wrong command line; the errors of read_configuration().
[[nodiscard]] Expected<Arguments> parse_arguments(const std::vector<std::string>& words);

}  // namespace terracut::cli
