// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rt/error.hpp"
#include "tools/cli/settings/setting.hpp"

namespace terracut::cli {

/// A typed setting with its texts; an option without a value has its `bare` text.
struct TypedOption {
  const Setting* setting = nullptr;
  std::vector<std::string> texts;
};

/// The parsed command line.
struct CommandLine {
  std::optional<Command> command;  ///< Empty: print `text`, the help or the version.
  std::vector<TypedOption> typed;
  std::string text;
};

/// Parses words that passed check_names(). Help shows the values of `in_force` as defaults.
/// kInvalidArgument: an option given twice, or too many arguments.
[[nodiscard]] Expected<CommandLine> read_command_line(const std::vector<std::string>& words,
                                                      const Options& in_force);

}  // namespace terracut::cli
