// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/decode/decoder.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Returns the decoder's configuration. `columns` is the range image's width, 0 for the sensor's
/// default. `motion` is the vehicle's, for deskewing; null: frames are not deskewed.
[[nodiscard]] decode::Decoder::Config decoder_config_of(const Options& options, int columns,
                                                        vehicle::EgoMotion* motion = nullptr);

}  // namespace terracut::cli
