// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "configuration.hpp"

namespace terracut::cli {

/// What a command starts from before its command line is read. The method's parameters are left
/// out: they are set before those of --set, see arguments.cpp.
void start_from(const Configuration& configuration, ReplayOptions& options);
void start_from(const Configuration& configuration, SegmentOptions& options);
void start_from(const Configuration& configuration, SimulateOptions& options);
void start_from(const Configuration& configuration, EncodeOptions& options);
void start_from(const Configuration& configuration, CalibrateOptions& options);
void start_from(const Configuration& configuration, PlanOptions& options);
void start_from(const Configuration& configuration, BenchOptions& options);
void start_from(const Configuration& configuration, EvalOptions& options);
void start_from(const Configuration& configuration, LiveOptions& options);
void start_from(const Configuration& configuration, ConfigOptions& options);
void start_from(const Configuration& configuration, DoctorOptions& options);

}  // namespace terracut::cli
