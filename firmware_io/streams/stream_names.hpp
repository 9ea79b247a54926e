// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "firmware_io/streams/sensor_stream.hpp"

namespace terracut::streams {

/// Where several sensors were heard. This decides which options can choose one of them.
enum class HeardIn : std::uint8_t { kCapture, kLiveRun };

/// What one of several sensors is called, and the options that choose it from the others.
struct StreamName {
  std::string name;     ///< "Velodyne VLP-16 at 192.168.1.201 to port 2369"
  std::string options;  ///< "--port 2369"
};
/// Returns the names of the sensors, made of as few marks as tell them all apart.
[[nodiscard]] std::vector<StreamName> names_of(std::span<const SensorStream> sensors,
                                               HeardIn heard_in);

/// Returns how to choose one of several sensors: "A, B; choose one with --port 2368 or --port
/// 2369".
[[nodiscard]] std::string choice_text(std::span<const SensorStream> sensors, HeardIn heard_in);

}  // namespace terracut::streams
