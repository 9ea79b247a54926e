// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "firmware_io/decode/decoder.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// What its caller does with frames. For labels alone they may keep their returns as measured.
enum class FramesAreFor : std::uint8_t { kLabels, kPoints };

/// The decoder that the options ask for. `columns`: of the range image, 0 for the sensor's default.
/// `motion`: the vehicle's, by which frames are deskewed; null: they are not.
[[nodiscard]] decode::Decoder::Config decoder_config_of(const Options& options, int columns,
                                                        FramesAreFor purpose,
                                                        vehicle::EgoMotion* motion = nullptr);

}  // namespace terracut::cli
