// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Checks that the files of a live run (calibration, setup, DBC file) can be read, before it waits
/// for its sensor. If the model is unknown, the calibration must fit some model. Errors name the
/// file.
[[nodiscard]] Status check_inputs(const Options& options);

}  // namespace terracut::cli
