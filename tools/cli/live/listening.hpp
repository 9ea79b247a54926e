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

/// Returns the configuration for listening with these options.
[[nodiscard]] net::ListenConfig listen_config_of(const Options& options);

/// Listens until a sensor and its calibration are known, at most for `options.patience_s` if given,
/// or until stop_wanted(). Calls `on_waiting` many times a second with a text about what is
/// missing. Of several sensors it takes the one that the last run used (KnownSensor). Fails as
/// FirstSeconds::conclude() does.
using OnWaiting = std::function<void(const std::string& what)>;
[[nodiscard]] Expected<streams::SensorOnAir> listen_for_sensor(net::LiveSource& source,
                                                               const Options& options,
                                                               const OnWaiting& on_waiting);

}  // namespace terracut::cli
