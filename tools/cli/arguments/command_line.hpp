// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rt/error.hpp"
#include "tools/cli/settings/setting.hpp"

namespace terracut::cli {

/// A setting with the texts typed for it. An option typed without a value has the setting's `bare`
/// text.
struct TypedOption {
  const Setting* setting = nullptr;
  std::vector<std::string> texts;
};

/// The parsed command line.
struct CommandLine {
  std::optional<Command> command;  ///< Empty: print `text`, which is the help or the version.
  std::vector<TypedOption> typed;
  std::string text;
};

/// Parses words that have passed check_names(). Help shows the values of `in_force` as defaults.
/// Fails with kInvalidArgument if an option is given twice or there are too many arguments.
[[nodiscard]] Expected<CommandLine> read_command_line(const std::vector<std::string>& words,
                                                      const Options& in_force);

}  // namespace terracut::cli
