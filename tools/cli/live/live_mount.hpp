// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/net/live_source.hpp"
#include "firmware_io/streams/first_seconds.hpp"
#include "tools/cli/input/mount_choice.hpp"
#include "tools/cli/live/listening.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// The mount of a sensor that is heard: what is not stated as the first frames show it. Listens
/// for a second, for ten where these do not show enough of the ground (three with --mount-guess),
/// and until stop_wanted(). Says what it found, or that it goes on with a guess: a vehicle needs
/// labels.
[[nodiscard]] MountChoice mount_on_air(net::LiveSource& source, const streams::SensorOnAir& sensor,
                                       const Options& options, const OnWaiting& on_waiting);

}  // namespace terracut::cli
