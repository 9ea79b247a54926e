// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <optional>
#include <variant>

#include "live/live_options.hpp"
#include "options.hpp"

namespace terracut::cli {

using Command = std::variant<ReplayOptions, SegmentOptions, SimulateOptions, EncodeOptions,
                             CalibrateOptions, InfoOptions, PlanOptions, ParametersOptions,
                             BenchOptions, SendOptions, DumpOptions, TopOptions, EvalOptions,
                             CompareOptions, LiveOptions, ConfigOptions, DoctorOptions>;

/// The command line, read.
struct Arguments {
  std::optional<Command>
      command;  ///< Absent when help, the version or an error was printed instead.
  std::filesystem::path configuration;  ///< The file of --config; empty: none.
  int exit_code = 0;                    ///< What to exit with where there is no command.
};

[[nodiscard]] Arguments parse_arguments(int argc, char** argv);

}  // namespace terracut::cli
