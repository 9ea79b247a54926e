// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "firmware_io/streams/sensor_stream.hpp"

namespace terracut::streams {

/// Whether several sensors were heard in a capture or in a live run, which have different options
/// to choose one.
enum class HeardIn : std::uint8_t { kCapture, kLiveRun };

/// The name of one of several sensors, and the options that choose it.
struct StreamName {
  std::string name;     ///< "Velodyne VLP-16 at 192.168.1.201 to port 2369"
  std::string options;  ///< "--port 2369"
};
/// Returns names for the sensors, built from as few properties as distinguish them all.
[[nodiscard]] std::vector<StreamName> names_of(std::span<const SensorStream> sensors,
                                               HeardIn heard_in);

/// Returns how to choose one of several sensors: "A, B; choose one with --port 2368 or --port
/// 2369".
[[nodiscard]] std::string choice_text(std::span<const SensorStream> sensors, HeardIn heard_in);

}  // namespace terracut::streams
