// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "rt/error.hpp"

namespace terracut::cli {

/// How a run of the program ended, and what it cost.
struct ProgramRun {
  int exit_code = -1;  ///< -1: ended by a signal.
  int signal = 0;
  double seconds = 0, cpu_seconds = 0;
  std::uint64_t peak_memory_bytes = 0;
};

/// Runs this very program, even if its file was replaced meanwhile, with other arguments, and waits
/// for it. The child's standard error goes to the file `log`, its standard output nowhere. The
/// child is killed when this process ends, however that happens; catch_stop_signals() with
/// stop_program() also asks it to stop. Fails with kWriteFailed if it cannot be started. For one
/// thread at a time.
[[nodiscard]] Expected<ProgramRun> run_program(const std::vector<std::string>& words,
                                               const std::filesystem::path& log);

/// Passes a stop signal on to the child; for catch_stop_signals(). Safe in a signal handler.
void stop_program() noexcept;

}  // namespace terracut::cli
