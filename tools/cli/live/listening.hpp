// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "firmware_io/net/live_source.hpp"
#include "firmware_io/streams/first_seconds.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// What the options ask for.
[[nodiscard]] net::ListenConfig listen_config_of(const Options& options);

/// Listens until a sensor is known and its calibration, too: as long as it takes, at most
/// `options.patience_s` where there is such, or until stop_wanted(). `on_waiting` is told many
/// times a second what is waited for. Of several sensors it is the one that the run before heard
/// (KnownSensor). The errors of FirstSeconds::conclude().
using OnWaiting = std::function<void(const std::string& what)>;
[[nodiscard]] Expected<streams::SensorOnAir> listen_for_sensor(net::LiveSource& source,
                                                               const Options& options,
                                                               const OnWaiting& on_waiting);

}  // namespace terracut::cli
