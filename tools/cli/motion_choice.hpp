// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/can/motion_signals.hpp"
#include "firmware_io/motion/deskew_info.hpp"
#include "firmware_io/motion/ego_motion.hpp"
#include "options.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// The signals that the configuration names, in the DBC file that it names. kInvalidArgument when
/// no file is given, else errors as read_dbc() and MotionSignals::make().
[[nodiscard]] Expected<firmware_io::MotionSignals> motion_signals_of(const MotionOptions& options);

[[nodiscard]] firmware_io::EgoMotion::Config ego_motion_config_of(const MotionOptions& options);
[[nodiscard]] firmware_io::TurnInstant turn_instant_of(const MotionOptions& options);

}  // namespace terracut::cli
