// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "device_clock.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace terracut::cli {
namespace {

/// TAI minus UTC in seconds since 2017. Some units subtract it although the PTP master sends UTC.
constexpr double kLeapSeconds = 37;
constexpr double kLeapTolerance_s = 0.5;

std::string duration_text(double seconds) {
  if (seconds < 1) return fmt::format("{:.1f} ms", 1000 * seconds);
  if (seconds < 3600) return fmt::format("{:.1f} s", seconds);
  if (seconds < 86'400) return fmt::format("{:.1f} h", seconds / 3600);
  return fmt::format("{:.1f} days", seconds / 86'400);
}

}  // namespace

std::string DeviceClock::text() const {
  const double ahead_s = static_cast<double>(ahead_ns_) * 1e-9;
  return fmt::format("{} ({}), {} {} the capture", to_string(encoding_),
                     proven_ ? "proven" : "most likely", duration_text(std::abs(ahead_s)),
                     ahead_s < 0 ? "behind" : "ahead of");
}

std::string DeviceClock::warning() const {
  const double ahead_s = static_cast<double>(ahead_ns_) * 1e-9;
  if (std::abs(std::abs(ahead_s) - kLeapSeconds) > kLeapTolerance_s) return {};
  return fmt::format(
      "the sensor's clock is {:.1f} s {} the capture's: the leap seconds that units of this family "
      "take off under PTP even where the master sends UTC. If so, give --clock-offset {:.0f}",
      std::abs(ahead_s), ahead_s < 0 ? "behind" : "ahead of", ahead_s < 0 ? 37.0 : -37.0);
}

}  // namespace terracut::cli
