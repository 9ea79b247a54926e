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

/// The thresholds at which the near ground contradicts a mount.
///
/// The tolerances lie between the errors measured with right mounts and those to be reported: 0.3
/// m, 3 degrees of pitch, 4 of roll; docs/reference/method.md, "Is the mount right?". Smaller
/// errors are left to `terracut calibrate`.
struct MountCheckConfig {
  double height_tolerance_m = 0.20;    ///< Right mounts: 0.12 m at most, on a hill.
  double pitch_tolerance_rad = 0.044;  ///< 2.5 degrees. Right mounts: 1.0 at most.
  double roll_tolerance_rad = 0.061;   ///< 3.5 degrees. Right mounts: 2.8 for a second.
  /// A frame contradicts the mount only if the ground that the mount predicts is not seen either:
  /// where it and the plane found are apart, points on it are fewer than this share of those on the
  /// plane found. A roof, a lorry, a crest or a hollow makes another plane but leaves the road
  /// beside it.
  double most_support = 0.15;
  std::size_t frames_kept = 10;      ///< The number of newest frames judged together.
  std::size_t least_frames = 3;      ///< With fewer there is no verdict.
  double contradicting_share = 0.7;  ///< Least share of the judged frames.
};

/// Compares a mount with the ground that a run sees, frame by frame. Start-up or threads without a
/// deadline: add_frame() allocates and takes milliseconds. Deterministic.
class MountCheck {
 public:
  explicit MountCheck(const Mount& mount, const MountCheckConfig& config = {});

  /// Adds the near points of one frame, in the vehicle frame of the given mount. A frame in which
  /// no ground is found is ignored.
  void add_frame(std::span<const std::array<float, 3>> points);

  /// Returns the mount that the ground shows, the median over the frames that contradict the given
  /// one; nothing while the given mount is not contradicted.
  [[nodiscard]] std::optional<Mount> contradiction() const;

  /// Returns the mean mount over all frames so far whose ground is within the tolerances: a long
  /// drive knows it better than its first second. Nothing without such a frame.
  [[nodiscard]] std::optional<Mount> by_drive() const;

  /// Returns the number of frames with a ground so far.
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
  std::vector<Frame> newest_;  ///< At most frames_kept, a ring buffer.
  std::uint64_t frames_ = 0;
  Mount sum_{.height_m = 0, .roll_rad = 0, .pitch_rad = 0};  ///< The sums of by_drive().
  std::uint64_t in_sum_ = 0;
};

}  // namespace terracut::mount
