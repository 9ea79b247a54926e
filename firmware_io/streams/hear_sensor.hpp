// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "firmware_io/net/live_source.hpp"
#include "firmware_io/streams/first_seconds.hpp"
#include "rt/error.hpp"

namespace terracut::streams {

/// How long to wait for a sensor, and whom to tell.
struct Waiting {
  std::optional<double> patience_s;  ///< Longest time to wait; empty: unlimited.
  std::function<bool()> stop_wanted;
  /// Called many times a second with the text of what is missing; may be empty.
  std::function<void(const std::string& what)> on_waiting;
};

/// Listens at `data`, and at `device` unless that is null, until `first` has heard enough. Fails as
/// FirstSeconds::conclude() does. Start-up: allocates.
[[nodiscard]] Expected<SensorOnAir> hear_sensor(FirstSeconds& first, net::LiveSource& data,
                                                net::LiveSource* device, const Waiting& waiting);

}  // namespace terracut::streams
