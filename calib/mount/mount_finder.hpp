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

/// The mount for which vehicle and sensor frame are the same; MountFinder gets frames made with
/// this mount.
inline constexpr Mount kAtTheSensor{.height_m = 0, .roll_rad = 0, .pitch_rad = 0};
/// The number of frames for finding a mount at the start of a run: a second of most sensors.
inline constexpr std::size_t kFramesToFind = 10;

/// Returns the median height, the median roll and the median pitch.
[[nodiscard]] Mount median_of(std::span<const Mount> mounts);

/// The mount that the ground shows during a run.
struct FoundMount {
  /// Rounded to whole millimetres and hundredths of a degree, so that printed figures state exactly
  /// this mount and the last bit of a mathematical library does not matter.
  Mount mount;
  /// Half the width of the 95 % interval of `mount`, from the ground's unevenness, how much of it
  /// is seen, and the spread between frames.
  Mount uncertainty;
  std::size_t frames = 0;  ///< Number of frames the mount was found from.

  /// True if the mount is good enough for labels: its uncertainty is within 0.15 m and 2.5 degrees.
  /// A less certain mount labels worse than a level one (docs/reference/mount.md).
  [[nodiscard]] bool is_certain() const noexcept;
};

/// Returns "height 1.731 m (+-0.018), roll 0.00 deg (stated), pitch 0.31 deg (+-0.2), found in 10
/// frames". A value without uncertainty is shown as stated.
[[nodiscard]] std::string to_string(const FoundMount& found);
/// Returns the error kMountNotFound for a mount that is too uncertain.
[[nodiscard]] Error uncertain(const FoundMount& found);

/// Finds the mount from the first frames of a run; a second of them is enough. Takes the median
/// over the frames, so one in which the road is hidden does no harm. Start-up: allocates, takes
/// milliseconds a frame. Deterministic.
class MountFinder {
 public:
  /// Adds the near points of one frame, in the sensor frame, of the strip that the vehicle stands
  /// on (pipeline/ground/near_ground.hpp). True if a ground is found among them.
  bool add_frame(std::span<const std::array<float, 3>> points);
  /// Adds the estimate made elsewhere for a frame. True if it is a mount, false if an error.
  bool add_estimate(const Expected<MountEstimate>& estimated);

  /// Returns the number of frames in which a ground was found.
  [[nodiscard]] std::size_t frames() const noexcept { return seen_.size(); }
  [[nodiscard]] std::size_t frames_looked_at() const noexcept { return looked_at_; }

  /// Returns the mount. Fails with kMountNotFound, and the last frame's reason, if fewer than half
  /// of the frames show a ground.
  [[nodiscard]] Expected<FoundMount> found() const;
  /// Returns the mount if it is certain enough for labels; else fails with kMountNotFound, and the
  /// message gives the mount and its uncertainty.
  [[nodiscard]] Expected<FoundMount> certain() const;

 private:
  std::vector<Mount> seen_, deviations_;
  std::size_t looked_at_ = 0;
  std::string last_fault_ = "there was no frame to look at";
};

}  // namespace terracut::mount
