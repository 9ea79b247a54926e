// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/sensor/sensor_decoder.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// The decoder that the options ask for, without the vehicle's motion.
/// `columns`: of the range image, 0 for the sensor's default.
[[nodiscard]] sensor::SensorDecoder::Config decoder_config_of(const CaptureOptions& options,
                                                              int columns);

}  // namespace terracut::cli
