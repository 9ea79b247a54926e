// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "motion_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace terracut::cli {
namespace {

/// Splits "A.B, C" at the commas and trims the parts.
std::vector<std::string> names_in(std::string_view text) {
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    std::string_view name = text.substr(begin, end - begin);
    name.remove_prefix(std::min(name.find_first_not_of(' '), name.size()));
    name = name.substr(0, name.find_last_not_of(' ') + 1);
    names.emplace_back(name);
    begin = end + 1;
  }
  return names;
}

}  // namespace

Expected<vehicle::MotionSignals> motion_signals_of(const MotionOptions& options) {
  if (options.dbc.empty()) {
    return fail(
        ErrorCode::kInvalidArgument,
        "no DBC file is given (--dbc, motion.dbc): it says what the vehicle's CAN frames mean");
  }
  const auto file = vehicle::read_dbc(options.dbc);
  if (!file) return tl::unexpected(file.error());
  vehicle::MotionSignalsConfig config{.speed = options.speed,
                                      .yaw_rate = options.yaw_rate,
                                      .max_age_s = options.max_age_ms / 1000,
                                      .timeout_s = options.timeout_ms / 1000};
  config.speed.signals = names_in(options.speed_signals);
  config.yaw_rate.signals = names_in(options.yaw_rate_signals);
  auto motion = vehicle::MotionSignals::make(*file, config);
  if (!motion) {
    return fail(motion.error().code,
                fmt::format("{}; the keys below motion of the configuration say which signals are "
                            "meant, and how",
                            motion.error().message));
  }
  return motion;
}

vehicle::EgoMotion::Config ego_motion_config_of(const MotionOptions& options) {
  vehicle::EgoMotion::Config config;
  config.max_age_ns = static_cast<std::int64_t>(options.max_age_ms * 1e6);
  config.sensor_ahead_m = options.sensor_ahead_m;
  config.sensor_left_m = options.sensor_left_m;
  return config;
}

}  // namespace terracut::cli
