// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/net/live_source.hpp"
#include "firmware_io/streams/first_seconds.hpp"
#include "tools/cli/input/mount_choice.hpp"
#include "tools/cli/live/listening.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Returns the mount of a live sensor; figures not stated are estimated from the first frames.
/// Listens for a second; if its frames do not show enough ground, for up to ten (three with
/// --mount-guess), or until stop_wanted(). Prints the mount, or that the run goes on with a guess.
[[nodiscard]] MountChoice mount_on_air(net::LiveSource& source, const streams::SensorOnAir& sensor,
                                       const Options& options, const OnWaiting& on_waiting);

}  // namespace terracut::cli
