// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "exit_codes.hpp"
#include "live/live_options.hpp"
#include "options.hpp"

/// The subcommands: each does its work, prints its result and answers the program's exit code.
namespace terracut::cli {

[[nodiscard]] ExitCode run(const ReplayOptions& options);
[[nodiscard]] ExitCode run(const SegmentOptions& options);
[[nodiscard]] ExitCode run(const SimulateOptions& options);
[[nodiscard]] ExitCode run(const EncodeOptions& options);
[[nodiscard]] ExitCode run(const CalibrateOptions& options);
[[nodiscard]] ExitCode run(const InfoOptions& options);
[[nodiscard]] ExitCode run(const PlanOptions& options);
[[nodiscard]] ExitCode run(const ParametersOptions& options);
[[nodiscard]] ExitCode run(const BenchOptions& options);
[[nodiscard]] ExitCode run(const SendOptions& options);
[[nodiscard]] ExitCode run(const DumpOptions& options);
[[nodiscard]] ExitCode run(const TopOptions& options);
ExitCode run(const EvalOptions& options);
[[nodiscard]] ExitCode run(const CompareOptions& options);
[[nodiscard]] ExitCode run(const LiveOptions& options);
[[nodiscard]] ExitCode run(const ConfigOptions& options);
[[nodiscard]] ExitCode run(const DoctorOptions& options);

}  // namespace terracut::cli
