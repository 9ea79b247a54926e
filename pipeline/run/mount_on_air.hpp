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

/// Gives a mount finder the frames of one second from a live sensor. As long as they do not show
/// the mount for certain, tries again with the next second, until `patience` is over or
/// stop_wanted() returns true. Calls `on_waiting` many times a second with a text about what is
/// missing. Start-up only: allocates.
[[nodiscard]] mount::MountFinder mount_on_air(
    net::LiveSource& source, const streams::SensorOnAir& sensor,
    const decode::Decoder::Config& config, std::chrono::seconds patience,
    const std::function<bool()>& stop_wanted,
    const std::function<void(const std::string& what)>& on_waiting = [](const std::string&) {});

/// The longest time to listen for frames that show the ground, which may be hidden where the
/// vehicle stands.
inline constexpr std::chrono::seconds kGroundPatience{10};

}  // namespace terracut::run
