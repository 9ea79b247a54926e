// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/net/live_source.hpp"
#include "firmware_io/streams/first_seconds.hpp"
#include "tools/cli/input/mount_choice.hpp"
#include "tools/cli/live/listening.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Returns the mount of a sensor on air, with the missing figures estimated from the first frames.
/// Listens for a second, for ten if these do not show enough ground (three with --mount-guess), and
/// until stop_wanted(). Prints the result, or that it goes on with a guess: a vehicle needs labels.
[[nodiscard]] MountChoice mount_on_air(net::LiveSource& source, const streams::SensorOnAir& sensor,
                                       const Options& options, const OnWaiting& on_waiting);

}  // namespace terracut::cli
