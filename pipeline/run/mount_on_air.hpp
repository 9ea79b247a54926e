// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <functional>

#include "calib/mount/mount_finder.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/net/live_source.hpp"
#include "firmware_io/sensor/first_seconds.hpp"

namespace terracut::run {

/// Shows a finder the frames of a sensor that is heard: a second of them, three where these do not
/// show enough of the ground, and not beyond stop_wanted(). `on_waiting` is called many times a
/// second. `config`: of frames with points. Start-up: allocates.
[[nodiscard]] mount::MountFinder mount_on_air(
    net::LiveSource& source, const sensor::SensorOnAir& sensor,
    const decode::Decoder::Config& config, const std::function<bool()>& stop_wanted,
    const std::function<void()>& on_waiting = [] {});

}  // namespace terracut::run
