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

/// A sensor whose vehicle frame is its own: of frames that a MountFinder is shown.
inline constexpr Mount kAtTheSensor{.height_m = 0, .roll_rad = 0, .pitch_rad = 0};
/// Frames that a mount is read off at the start of a run: a second of most sensors.
inline constexpr std::size_t kFramesToFind = 10;

/// Height, roll and pitch, each the median of its own.
[[nodiscard]] Mount median_of(std::span<const Mount> mounts);

/// The mount that a run's ground shows.
struct FoundMount {
  /// In whole millimetres and hundredths of a degree: stated as it is printed it is the same mount,
  /// and it does not hang on the last bit of a mathematical library.
  Mount mount;
  /// Half the width of the interval that holds the true figure in 95 of 100 cases, as the ground's
  /// unevenness, what of it was seen, and the difference from frame to frame let expect.
  Mount uncertainty;
  std::size_t frames = 0;  ///< It was read off.

  /// Whether it is good for labels: to 0.15 m, and 2.5 degrees. Labels by a mount that is less
  /// certain are worse than those of a level one (docs/reference/method.md, "The mount, found").
  [[nodiscard]] bool is_certain() const noexcept;
};

/// "height 1.731 m (+-0.018), roll 0.00 deg (stated), pitch 0.31 deg (+-0.2), found in 10 frames":
/// what has no uncertainty was stated.
[[nodiscard]] std::string to_string(const FoundMount& found);
/// kMountNotFound: one that is not certain.
[[nodiscard]] Error uncertain(const FoundMount& found);

/// Finds the mount from the first frames of a run, a second of them being enough. The median of
/// frames, so that one whose road is hidden spoils nothing. Start-up: allocates, takes milliseconds
/// a frame. Deterministic.
class MountFinder {
 public:
  /// Near points of one frame, in the sensor's frame, of the strip that the vehicle stands on
  /// (pipeline/ground/near_ground.hpp). Whether they show a ground.
  bool add_frame(std::span<const std::array<float, 3>> points);
  /// What one frame shows, estimated already.
  bool add_estimate(const Expected<MountEstimate>& estimated);

  [[nodiscard]] std::size_t frames() const noexcept { return seen_.size(); }  ///< With a ground.
  [[nodiscard]] std::size_t frames_looked_at() const noexcept { return looked_at_; }

  /// kMountNotFound where fewer than half of the frames show a ground, saying why the last of them
  /// did not.
  [[nodiscard]] Expected<FoundMount> found() const;
  /// What labels can be made by. kMountNotFound also where it is not certain, saying what it is.
  [[nodiscard]] Expected<FoundMount> certain() const;

 private:
  std::vector<Mount> seen_, deviations_;
  std::size_t looked_at_ = 0;
  std::string last_fault_ = "there was no frame to look at";
};

}  // namespace terracut::mount
