// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "calib/mount/mount.hpp"
#include "firmware_io/scan/kitti_scan.hpp"
#include "rt/error.hpp"
#include "sensor_effects.hpp"
#include "shot_pattern.hpp"

namespace terracut::simulator {

/// A drive of a sensor without rows. The same configuration gives the same clouds.
struct CloudDriveConfig {
  std::string scene = "street";  ///< One of scene_names().
  std::uint64_t seed = 1;        ///< Seed of all random values: world, noise, drop-outs.
  double duration_s = 3;         ///< Rounded to whole clouds, at least one; (0, 3600].
  double clouds_hz = 10;         ///< [5, 20]
  double speed_mps = -1;         ///< Speed of the vehicle, at most 60; < 0: the scene's usual.
  mount::Mount mount{};
  SensorEffects effects{};
};

/// The points of one cloud in the sensor frame, in the order of the shots, and their SemanticKITTI
/// classes. Valid during the call only.
struct SimulatedCloud {
  std::span<const scan::ScanPoint> points;
  std::span<const std::uint32_t> truth;
};
using CloudSink = std::function<Status(const SimulatedCloud&)>;

/// Simulates clouds as a driver gives them that compensates for motion: vehicle and objects stand
/// still during each cloud and jump between them. Fails with kInvalidArgument for a scene that does
/// not exist, or with the error of `sink`. Not real-time safe; allocates.
[[nodiscard]] Status simulate_clouds(const CloudDriveConfig& config, const ShotPattern& pattern,
                                     const CloudSink& sink);

}  // namespace terracut::simulator
