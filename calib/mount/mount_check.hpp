// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "calib/mount/mount.hpp"

namespace terracut::mount {

/// The thresholds at which the near ground contradicts a mount. The tolerances lie between the
/// errors measured with right mounts and the errors that must be reported: 0.3 m, 3 degrees of
/// pitch, 4 degrees of roll (docs/reference/mount.md, "Is the mount right?"). Smaller errors are
/// left to `terracut calibrate`.
struct MountCheckConfig {
  double height_tolerance_m = 0.20;    ///< Right mounts are off by 0.12 m at most, on a hill.
  double pitch_tolerance_rad = 0.044;  ///< 2.5 degrees; right mounts are off by 1.0 at most.
  /// 3.5 degrees; right mounts seem off by up to 2.8 degrees for a second.
  double roll_tolerance_rad = 0.061;
  /// A frame contradicts the mount only if the ground that the mount predicts is not seen: where
  /// that ground and the plane found lie apart, the ground holds less than this share of the
  /// plane's number of points. A roof, a lorry, a crest or a hollow makes another plane, but the
  /// road beside it is still seen.
  double most_support = 0.15;
  std::size_t frames_kept = 10;  ///< How many of the newest frames are judged together.
  std::size_t least_frames = 3;  ///< With fewer frames there is no verdict.
  /// The mount is contradicted if at least this share of the judged frames contradicts it.
  double contradicting_share = 0.7;
};

/// Compares a mount with the ground that a run sees, frame by frame. For start-up or threads
/// without a deadline: add_frame() allocates and takes milliseconds. Deterministic.
class MountCheck {
 public:
  explicit MountCheck(const Mount& mount, const MountCheckConfig& config = {});

  /// Adds the near points of one frame, in the vehicle frame of the given mount. Ignores a frame in
  /// which no ground is found.
  void add_frame(std::span<const std::array<float, 3>> points);

  /// Returns the mount that the ground shows: the median over the frames that contradict the given
  /// mount. Returns nothing while there are too few such frames.
  [[nodiscard]] std::optional<Mount> contradiction() const;

  /// Returns the mean mount over all frames whose ground is within the tolerances: a long drive
  /// measures the mount better than its first second. Returns nothing without such a frame.
  [[nodiscard]] std::optional<Mount> by_drive() const;

  /// Returns the number of frames in which a ground was found.
  [[nodiscard]] std::uint64_t frames() const noexcept { return frames_; }
  [[nodiscard]] const Mount& mount() const noexcept { return mount_; }

 private:
  struct Frame {
    Mount seen;
    bool contradicts = false;
  };

  [[nodiscard]] bool contradicts(const Mount& seen) const;

  Mount mount_;
  MountCheckConfig config_;
  std::vector<Frame> newest_;  ///< Ring buffer of at most frames_kept frames.
  std::uint64_t frames_ = 0;
  /// The sums from which by_drive() takes its mean.
  Mount sum_{.height_m = 0, .roll_rad = 0, .pitch_rad = 0};
  std::uint64_t in_sum_ = 0;
};

}  // namespace terracut::mount
