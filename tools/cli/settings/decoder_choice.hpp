// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/decode/decoder.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// The decoder that the options ask for. `columns`: of the range image, 0 for the sensor's default.
/// `motion`: the vehicle's, by which frames are deskewed; null: they are not.
[[nodiscard]] decode::Decoder::Config decoder_config_of(const Options& options, int columns,
                                                        vehicle::EgoMotion* motion = nullptr);

}  // namespace terracut::cli
