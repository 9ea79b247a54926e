// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "calib/mount.hpp"

namespace terracut::calib {

/// From when on the near ground contradicts a mount.
///
/// The tolerances are twice what right mounts were ever seen off by: in one turn of a simulated
/// drive (five scenes, both sensors, 0.8 to 3 m, slopes and kerbs included) and of the recorded
/// scans, docs/method.md. What is less than that is left to `terracut calibrate`.
struct MountCheckConfig {
  double height_tolerance_m = 0.25;
  double tilt_tolerance_rad = 0.07;  ///< 4 degrees, of roll and of pitch.
  /// The ground may not be where the mount has it, too: where the two lie apart, fewer points than
  /// this share of those on the plane that was found lie on the mount's own. A roof under the
  /// sensor, a lorry ahead, a crest or a hollow has a plane of its own, but leaves the road beside
  /// it.
  double most_support = 0.15;
  std::size_t turns_kept = 10;       ///< The newest that are judged together.
  std::size_t least_turns = 3;       ///< Fewer say nothing.
  double contradicting_share = 0.7;  ///< Of these turns.
};

/// Compares a mount with the ground that a run sees, turn by turn. Start-up or threads without a
/// deadline: add_turn() allocates and takes milliseconds. Deterministic.
class MountCheck {
 public:
  explicit MountCheck(const Mount& mount, const MountCheckConfig& config = {});

  /// Near points of one turn in the vehicle frame that the mount leads to. A turn in which no
  /// ground is found counts for nothing.
  void add_turn(std::span<const std::array<float, 3>> points);

  /// The mount that the ground shows, medians over the turns that contradict the given one; nothing
  /// as long as that is not contradicted.
  [[nodiscard]] std::optional<Mount> contradiction() const;

  /// Turns with a ground so far.
  [[nodiscard]] std::uint64_t turns() const noexcept { return turns_; }
  [[nodiscard]] const Mount& mount() const noexcept { return mount_; }

 private:
  struct Turn {
    Mount seen;
    bool contradicts = false;
  };

  [[nodiscard]] bool contradicts(const Mount& seen) const;

  Mount mount_;
  MountCheckConfig config_;
  std::vector<Turn> newest_;  ///< At most turns_kept, as a ring.
  std::uint64_t turns_ = 0;
};

}  // namespace terracut::calib
