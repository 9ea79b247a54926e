// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "firmware_io/vehicle/dbc_file.hpp"
#include "firmware_io/vehicle/motion_signals.hpp"
#include "tests/firmware_io/can/frames.hpp"
#include "tools/lab/drive/vehicle_log.hpp"

namespace terracut::test {

inline constexpr can::CanId kMotionId{0x1A0, false};

/// The signals that drives are logged with; lost without a sample for so long.
inline vehicle::MotionSignals signals_of_the_vehicle(double timeout_s) {
  const auto dbc = vehicle::parse_dbc(drive::vehicle_dbc(), "vehicle.dbc");
  EXPECT_TRUE(dbc);
  vehicle::MotionSignalsConfig config;
  config.speed.signals = {"SPEED"};
  config.yaw_rate.signals = {"YAW_RATE"};
  config.timeout_s = timeout_s;
  auto made = vehicle::MotionSignals::make(*dbc, config);
  EXPECT_TRUE(made) << made.error().message;
  return *std::move(made);
}

/// 72 km/h straight on.
inline can::CanFrame at_20_mps() {
  return data_frame(kMotionId, {0x1C, 0x20, 0, 0, 0, 0, 0, 0});
}

}  // namespace terracut::test
