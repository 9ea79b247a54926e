// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdio>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "firmware_io/vehicle/motion_sample.hpp"

namespace terracut::test {

/// What a vehicle log says, read by its description alone; a line that is not as described ends it.
inline std::vector<vehicle::MotionSample> samples_of(const std::string& log) {
  std::vector<vehicle::MotionSample> samples;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    long long seconds = 0;
    unsigned microseconds = 0, speed = 0, yaw_rate = 0, counter = 0;
    if (std::sscanf(line.c_str(), "(%10lld.%6u) can0 1A0#%4x%4x000000%2x", &seconds, &microseconds,
                    &speed, &yaw_rate, &counter) != 5 ||
        counter != samples.size() % 256) {
      break;
    }
    const auto value = [](unsigned raw) { return (raw < 32768 ? raw : raw - 65536.0) / 100; };
    samples.push_back({(seconds * 1'000'000 + microseconds) * 1000, value(speed) / 3.6,
                       value(yaw_rate) * std::numbers::pi / 180});
  }
  return samples;
}

}  // namespace terracut::test
