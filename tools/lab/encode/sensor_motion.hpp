// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "rt/error.hpp"

namespace terracut::encode {

/// Constant motion of the sensor, in its own frame (x forward, y left, z up).
struct SensorTwist {
  std::array<double, 3> angular_velocity_rad_s{};
  std::array<double, 3> velocity_m_s{};
  double frame_duration_s = 0.1;  ///< Duration of one revolution.
};

/// A rigid motion, row-major 3x4: p_to = rotation * p_from + translation.
using RigidMotion = std::array<double, 12>;

/// How the sensor moved during a recorded KITTI / SemanticKITTI sequence.
class SensorMotion {
 public:
  /// Reads poses.txt (a line a frame: 3x4 row-major pose of the left camera in the frame of the
  /// first one), times.txt (a line a frame: seconds) and the sensor's pose from the line "Tr:" of
  /// calib.txt (3x4, sensor to camera). Without that line the pose is that of the KITTI car's
  /// drawing: axes parallel, camera 0.27 m in front of the sensor and 0.08 m below. Line n is frame
  /// n. Fails with kNotFound, kUnreadable, kMalformed with file and line (wrong count of numbers,
  /// not finite, times that do not rise, unequal lengths, faster than any car).
  [[nodiscard]] static Expected<SensorMotion> read(
      const std::filesystem::path& poses, const std::filesystem::path& times,
      const std::optional<std::filesystem::path>& calib);

  [[nodiscard]] std::size_t frames() const noexcept { return times_s_.size(); }

  /// Returns the mean motion from the previous frame to the next one (at either end, between the
  /// frame and its only neighbour). Fails with kInvalidArgument for a frame that the files do not
  /// have.
  [[nodiscard]] Expected<SensorTwist> twist(std::uint32_t frame) const;

  /// Returns the motion that takes a static point from the sensor's frame at frame `from` to its
  /// frame at frame `to`. Nothing for a frame that the files do not have.
  [[nodiscard]] std::optional<RigidMotion> between(std::uint32_t from, std::uint32_t to) const;

 private:
  std::vector<RigidMotion> camera_poses_;
  std::vector<double> times_s_;
  RigidMotion T_camera_lidar_{};
  std::filesystem::path poses_path_;
};

}  // namespace terracut::encode
