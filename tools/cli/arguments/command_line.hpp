// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rt/error.hpp"
#include "tools/cli/settings/setting.hpp"

namespace terracut::cli {

/// A setting that was typed, with the texts it was given; one for an option alone, its `bare`.
struct TypedOption {
  const Setting* setting = nullptr;
  std::vector<std::string> texts;
};

/// The command line, taken apart.
struct CommandLine {
  std::optional<Command> command;  ///< None: `text` is to be printed, help or the version.
  std::vector<TypedOption> typed;
  std::string text;
};

/// Takes words apart that passed check_names(). Help shows the values of `in_force` as what holds
/// where an option is left out. kInvalidArgument: an option twice, an argument too many.
[[nodiscard]] Expected<CommandLine> read_command_line(const std::vector<std::string>& words,
                                                      const Options& in_force);

}  // namespace terracut::cli
