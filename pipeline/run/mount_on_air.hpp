// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "calib/mount/mount_finder.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/net/live_source.hpp"
#include "firmware_io/streams/first_seconds.hpp"

namespace terracut::run {

/// Shows a finder the frames of a sensor that is heard, a second of them; where these do not show
/// well enough how it stands, the next second's instead, for so long, and not beyond stop_wanted().
/// `on_waiting` is told many times a second what is waited for. `config`: of frames with points.
/// Start-up: allocates.
[[nodiscard]] mount::MountFinder mount_on_air(
    net::LiveSource& source, const streams::SensorOnAir& sensor,
    const decode::Decoder::Config& config, std::chrono::seconds patience,
    const std::function<bool()>& stop_wanted,
    const std::function<void(const std::string& what)>& on_waiting = [](const std::string&) {});

/// A vehicle that stands where no ground is seen is waited for so long; then there have to be
/// labels.
inline constexpr std::chrono::seconds kGroundPatience{10};

}  // namespace terracut::run
