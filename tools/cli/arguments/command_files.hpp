// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "tools/cli/arguments/arguments.hpp"
#include "tools/cli/files/run_files.hpp"

namespace terracut::cli {

/// What a command reads and writes: the paths that the table of settings marks so, and what lies
/// beside or below some of them; and what its outputs come of, by absolute paths.
[[nodiscard]] RunFiles files_of(Command command, const Options& options);

/// The same with the configuration file.
[[nodiscard]] RunFiles files_of(const Arguments& arguments);

/// "wrote     d.pcap", and in the lines below it what lies beside it: of `simulate` and `encode`.
[[nodiscard]] std::string wrote_drive(const Options& options);

}  // namespace terracut::cli
