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

/// From when on the near ground contradicts a mount.
///
/// The tolerances lie between what right mounts were seen off by and the errors that are to be
/// said: 0.3 m, 3 degrees of pitch, 4 of roll; docs/reference/method.md, "Is the mount right?".
/// What is less is left to `terracut calibrate`.
struct MountCheckConfig {
  double height_tolerance_m = 0.20;    ///< Right ones: 0.12 m at most, on a hill.
  double pitch_tolerance_rad = 0.044;  ///< 2.5 degrees. Right ones: 1.0 at most.
  double roll_tolerance_rad = 0.061;   ///< 3.5 degrees. Right ones: 2.8 for a second.
  /// The ground may not be where the mount has it, too: where the two lie apart, fewer points than
  /// this share of those on the plane that was found lie on the mount's own. A roof under the
  /// sensor, a lorry ahead, a crest or a hollow has a plane of its own, but leaves the road beside
  /// it.
  double most_support = 0.15;
  std::size_t frames_kept = 10;      ///< The newest that are judged together.
  std::size_t least_frames = 3;      ///< Fewer say nothing.
  double contradicting_share = 0.7;  ///< Of these frames.
};

/// Compares a mount with the ground that a run sees, frame by frame. Start-up or threads without a
/// deadline: add_frame() allocates and takes milliseconds. Deterministic.
class MountCheck {
 public:
  explicit MountCheck(const Mount& mount, const MountCheckConfig& config = {});

  /// Near points of one frame in the vehicle frame that the mount leads to. A frame in which no
  /// ground is found counts for nothing.
  void add_frame(std::span<const std::array<float, 3>> points);

  /// The mount that the ground shows, medians over the frames that contradict the given one;
  /// nothing as long as that is not contradicted.
  [[nodiscard]] std::optional<Mount> contradiction() const;

  /// How the sensor stands by all frames so far whose ground is within the tolerances, the mean of
  /// each figure: what a long drive knows better than its first second. Nothing without such a
  /// frame.
  [[nodiscard]] std::optional<Mount> by_drive() const;

  /// Frames with a ground so far.
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
  std::vector<Frame> newest_;  ///< At most frames_kept, as a ring.
  std::uint64_t frames_ = 0;
  Mount sum_{.height_m = 0, .roll_rad = 0, .pitch_rad = 0};  ///< Of by_drive().
  std::uint64_t in_sum_ = 0;
};

}  // namespace terracut::mount
