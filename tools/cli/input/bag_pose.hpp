// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string>

#include "calib/mount/mount.hpp"
#include "firmware_io/bag/bag.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// How the sensor of a topic stands, by the bag's /tf_static.
struct BagPose {
  /// Above the frame base_footprint, base_link or, of our own bags, terracut_ground.
  std::optional<mount::Mount> mount;
  /// Set if the topic's points are in one of these frames, and the tree has one other frame.
  std::optional<mount::RigidTransform> T_points_sensor;
  /// What was found, or why nothing was; empty if the bag has no static transforms.
  std::string note;
};

/// Reads the first ten seconds of a bag, where static transforms are. `topic` is one of its topics.
/// Leaves the bag at its beginning.
[[nodiscard]] BagPose pose_in(bag::Bag& bag, std::size_t topic);

/// Returns the mount that the user stated, its missing figures filled with those of `pose`, unless
/// a setup is given. Prints the note.
[[nodiscard]] MountOptions stated_or_of_bag(MountOptions stated, const BagPose& pose);

}  // namespace terracut::cli
