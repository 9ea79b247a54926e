// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "arguments.hpp"
#include "run_files.hpp"

namespace terracut::cli {

/// What each command reads and writes with these options: the one place that says so. A command
/// that gets an option for a file gets it declared here.
[[nodiscard]] RunFiles files_of(const ReplayOptions& options);
[[nodiscard]] RunFiles files_of(const SegmentOptions& options);
[[nodiscard]] RunFiles files_of(const SimulateOptions& options);
[[nodiscard]] RunFiles files_of(const EncodeOptions& options);
[[nodiscard]] RunFiles files_of(const CalibrateOptions& options);
[[nodiscard]] RunFiles files_of(const InfoOptions& options);
[[nodiscard]] RunFiles files_of(const PlanOptions& options);
[[nodiscard]] RunFiles files_of(const ParametersOptions& options);
[[nodiscard]] RunFiles files_of(const BenchOptions& options);
[[nodiscard]] RunFiles files_of(const SendOptions& options);
[[nodiscard]] RunFiles files_of(const DumpOptions& options);
[[nodiscard]] RunFiles files_of(const TopOptions& options);
[[nodiscard]] RunFiles files_of(const EvalOptions& options);
[[nodiscard]] RunFiles files_of(const CompareOptions& options);
[[nodiscard]] RunFiles files_of(const LiveOptions& options);
[[nodiscard]] RunFiles files_of(const ConfigOptions& options);
[[nodiscard]] RunFiles files_of(const DoctorOptions& options);

/// The same of any command, and of its configuration file.
[[nodiscard]] RunFiles files_of(const Command& command, const std::filesystem::path& configuration);

}  // namespace terracut::cli
