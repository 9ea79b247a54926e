// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// That the files which a live run reads can be read, before it waits for its sensor: calibration,
/// setup and DBC file. Of a calibration, where the model is not known yet, that some model takes
/// it. The errors of the files, naming them.
[[nodiscard]] Status check_inputs(const Options& options);

}  // namespace terracut::cli
