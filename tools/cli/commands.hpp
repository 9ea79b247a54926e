// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "exit_codes.hpp"
#include "options.hpp"

/// The subcommands: each does its work, prints its result and returns the program's exit code.
namespace terracut::cli {

[[nodiscard]] ExitCode run_replay(const Options& options);
[[nodiscard]] ExitCode run_view(const Options& options);
[[nodiscard]] ExitCode run_segment(const Options& options);
[[nodiscard]] ExitCode run_manifest(const Options& options);
[[nodiscard]] ExitCode run_relabel(const Options& options);
[[nodiscard]] ExitCode run_compare(const Options& options);
[[nodiscard]] ExitCode run_simulate(const Options& options);
[[nodiscard]] ExitCode run_encode(const Options& options);
[[nodiscard]] ExitCode run_calibrate(const Options& options);
[[nodiscard]] ExitCode run_info(const Options& options);
[[nodiscard]] ExitCode run_plan(const Options& options);
[[nodiscard]] ExitCode run_parameters(const Options& options);
[[nodiscard]] ExitCode run_detection(const Options& options);
[[nodiscard]] ExitCode run_bench(const Options& options);
[[nodiscard]] ExitCode run_send(const Options& options);
[[nodiscard]] ExitCode run_live(const Options& options);
[[nodiscard]] ExitCode run_node(const Options& options);
[[nodiscard]] ExitCode run_dump(const Options& options);
[[nodiscard]] ExitCode run_eval(const Options& options);
[[nodiscard]] ExitCode run_top(const Options& options);
[[nodiscard]] ExitCode run_config(const Options& options);
[[nodiscard]] ExitCode run_doctor(const Options& options);

}  // namespace terracut::cli
