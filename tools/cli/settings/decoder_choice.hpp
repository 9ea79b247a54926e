// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "firmware_io/decode/decoder.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// What frames are used for. For labels alone they may keep their returns as measured.
enum class FramesAreFor : std::uint8_t { kLabels, kPoints };

/// Returns the decoder's configuration. `columns` is the range image's width, 0 for the sensor's
/// default. `motion` is the vehicle's, for deskewing; null: frames are not deskewed.
[[nodiscard]] decode::Decoder::Config decoder_config_of(const Options& options, int columns,
                                                        FramesAreFor purpose,
                                                        vehicle::EgoMotion* motion = nullptr);

}  // namespace terracut::cli
