// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "calib/mount/mount.hpp"
#include "calib/mount/mount_estimate.hpp"
#include "rt/error.hpp"

namespace terracut::mount {

/// The mount that makes vehicle and sensor frame the same; MountFinder takes frames under it.
inline constexpr Mount kAtTheSensor{.height_m = 0, .roll_rad = 0, .pitch_rad = 0};
/// The number of frames for finding a mount at the start of a run: a second of most sensors.
inline constexpr std::size_t kFramesToFind = 10;

/// Returns the medians of height, roll and pitch, each taken by itself.
[[nodiscard]] Mount median_of(std::span<const Mount> mounts);

/// The mount that a run's ground shows.
struct FoundMount {
  /// Rounded to whole millimetres and hundredths of a degree: the printed figures state the same
  /// mount, and the last bit of a mathematical library does not matter.
  Mount mount;
  /// Half the width of the 95 % interval, from the ground's unevenness, its coverage, and the
  /// spread between frames.
  Mount uncertainty;
  std::size_t frames = 0;  ///< The number used.

  /// True if it is good enough for labels: within 0.15 m and 2.5 degrees. A less certain mount
  /// labels worse than a level one (docs/reference/method.md, "The mount, found").
  [[nodiscard]] bool is_certain() const noexcept;
};

/// Returns "height 1.731 m (+-0.018), roll 0.00 deg (stated), pitch 0.31 deg (+-0.2), found in 10
/// frames". A figure without uncertainty was stated.
[[nodiscard]] std::string to_string(const FoundMount& found);
/// Returns the error kMountNotFound for a mount that is not certain.
[[nodiscard]] Error uncertain(const FoundMount& found);

/// Finds the mount from the first frames of a run; a second of them is enough. Takes the median of
/// frames: one whose road is hidden does no harm. Start-up: allocates, takes milliseconds a frame.
/// Deterministic.
class MountFinder {
 public:
  /// Adds near points of one frame, in the sensor frame, of the strip that the vehicle stands on
  /// (pipeline/ground/near_ground.hpp). True if they show a ground.
  bool add_frame(std::span<const std::array<float, 3>> points);
  /// Adds a frame's estimate made elsewhere. True if it is one.
  bool add_estimate(const Expected<MountEstimate>& estimated);

  /// Returns the number of frames with a ground.
  [[nodiscard]] std::size_t frames() const noexcept { return seen_.size(); }
  [[nodiscard]] std::size_t frames_looked_at() const noexcept { return looked_at_; }

  /// Returns the mount; kMountNotFound, with the last frame's reason, if fewer than half of the
  /// frames show a ground.
  [[nodiscard]] Expected<FoundMount> found() const;
  /// Returns the mount if it is certain enough for labels, else kMountNotFound with the mount and
  /// its uncertainty.
  [[nodiscard]] Expected<FoundMount> certain() const;

 private:
  std::vector<Mount> seen_, deviations_;
  std::size_t looked_at_ = 0;
  std::string last_fault_ = "there was no frame to look at";
};

}  // namespace terracut::mount
