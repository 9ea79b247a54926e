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

/// The program's arguments, parsed.
struct Arguments {
  std::optional<Command> command;  ///< Empty: print `text`, which is the help or the version.
  std::string text;
  Options options;  ///< Defaults, overridden by the file, overridden by the command line.
  std::filesystem::path configuration;  ///< File given by --config; may be empty.
};

/// Reads the command line and the configuration file that it names. Fails with kInvalidArgument,
/// naming command and option, if the command line is wrong, and with the errors of
/// read_configuration() if the file is wrong.
[[nodiscard]] Expected<Arguments> parse_arguments(const std::vector<std::string>& words);

}  // namespace terracut::cli
