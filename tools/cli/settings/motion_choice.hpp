// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/vehicle/ego_motion.hpp"
#include "firmware_io/vehicle/motion_signals.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Returns the configured signals of the configured DBC file. Fails with kInvalidArgument if no
/// file is configured, and with the errors of read_dbc() and MotionSignals::make().
[[nodiscard]] Expected<vehicle::MotionSignals> motion_signals_of(const MotionOptions& options);

[[nodiscard]] vehicle::EgoMotion::Config ego_motion_config_of(const MotionOptions& options);

}  // namespace terracut::cli
