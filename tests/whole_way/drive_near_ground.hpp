// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "calib/mount/mount.hpp"
#include "pipeline/ground/near_ground.hpp"
#include "tools/lab/simulator/drive.hpp"

namespace terracut::whole_way {

/// Returns of one frame of a drive, in the sensor's frame.
using DriveFrame = std::vector<beams::Point>;

/// Drives so many frames with the sensor on `mount`, and hands each to `on_frame`.
template <class EncoderTraits, class OnFrame>
void drive_frames(const std::string& scene, const mount::Mount& mount, int frames,
                  const OnFrame& on_frame) {
  simulator::SimulationConfig<EncoderTraits> config;
  config.scene = scene;
  config.duration_s = 0.1 * frames;
  config.mount = mount;
  DriveFrame points;
  double frame_ends_s = 0.1;
  int shown = 0;
  const auto done = simulator::simulate_drive(
      config, [&](const simulator::SimulatedColumn<EncoderTraits>& column) {
        if (column.time_s >= frame_ends_s) {
          on_frame(points);
          points.clear();
          frame_ends_s += 0.1;
          ++shown;
        }
        for (std::size_t laser = 0; laser < column.exact.size(); ++laser) {
          if (column.wire.by_laser[laser].raw != 0) points.push_back(column.exact[laser]);
        }
        return Status{};
      });
  EXPECT_TRUE(done) << done.error().message;
  EXPECT_EQ(shown, frames);
}

/// Those of the strip before and behind the vehicle, as seen if the sensor stood on `given`.
inline std::vector<std::array<float, 3>> near_ground_of(const DriveFrame& points,
                                                        const mount::Mount& given) {
  const mount::RigidTransform T = mount::T_vehicle_lidar(given);
  std::vector<std::array<float, 3>> near;
  for (const beams::Point& p : points) {
    const auto [x, y, z] = mount::apply(T, p.x_m, p.y_m, p.z_m);
    const auto x_m = static_cast<float>(x), y_m = static_cast<float>(y);
    if (!ground::is_near_ground_place(x_m, y_m)) continue;
    near.push_back({x_m, y_m, static_cast<float>(z)});
  }
  return near;
}

}  // namespace terracut::whole_way
