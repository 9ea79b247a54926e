// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Checks that a live run's files can be read, before it waits for its sensor: calibration, setup
/// and DBC file. If the model is not known yet, some model must accept the calibration. Errors name
/// the file.
[[nodiscard]] Status check_inputs(const Options& options);

}  // namespace terracut::cli
