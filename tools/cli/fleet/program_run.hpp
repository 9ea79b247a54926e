// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "rt/error.hpp"

namespace terracut::cli {

/// How a run of the program ended, and what it took.
struct ProgramRun {
  int exit_code = -1;  ///< -1: a signal ended it.
  int signal = 0;
  double seconds = 0, cpu_seconds = 0;
  std::uint64_t peak_memory_bytes = 0;
};

/// Runs this very program, the file that runs now and not what stands in its place meanwhile, with
/// other words behind its name, and waits for it. Its standard error goes to the file `log`, its
/// standard output nowhere. It dies with this process, however that ends, and on
/// catch_stop_signals() with stop_program() it is asked to stop, too. kWriteFailed where it cannot
/// be started. From one thread at a time.
[[nodiscard]] Expected<ProgramRun> run_program(const std::vector<std::string>& words,
                                               const std::filesystem::path& log);

/// For catch_stop_signals(): passes the wish to stop on to the program that runs.
void stop_program() noexcept;

}  // namespace terracut::cli
