// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "tools/cli/arguments/arguments.hpp"
#include "tools/cli/files/run_files.hpp"

namespace terracut::cli {

/// Returns the files that a command reads and writes, by absolute path: those of options marked so
/// in the table of settings, related files beside or below them, and the inputs that its outputs
/// are made of.
[[nodiscard]] RunFiles files_of(Command command, const Options& options);

/// Returns the files of a command, including the configuration file.
[[nodiscard]] RunFiles files_of(const Arguments& arguments);

/// Returns "wrote     d.pcap" and lines for the files beside it, for `simulate` and `encode`.
[[nodiscard]] std::string wrote_drive(const Options& options);

}  // namespace terracut::cli
