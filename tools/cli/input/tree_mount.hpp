// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "calib/mount/mount.hpp"
#include "firmware_io/bag/transform_tree.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// The mount that static transforms state.
struct TreeMount {
  std::optional<mount::Mount> mount;  ///< Empty if the height is not one of a mount.
  std::string note;                   ///< What was found, for people.
};

/// True for base_footprint, base_link and terracut_ground: frames whose origin lies on the ground,
/// or (base_link) is taken to.
[[nodiscard]] bool is_vehicle_frame(std::string_view frame) noexcept;

/// Returns the mount of a sensor by its transform to a frame on the ground, whose x axis is ahead
/// as the sensor's is taken to be. `source` names the transforms in the note.
[[nodiscard]] TreeMount mount_by(const mount::RigidTransform& T_vehicle_sensor,
                                 std::string_view sensor, std::string_view vehicle,
                                 std::string_view source);

/// Returns the mount of a sensor's frame above `vehicle`, or, if that is empty, above the first
/// vehicle frame that the tree joins it with; nothing if the tree joins them not.
[[nodiscard]] std::optional<TreeMount> mount_in(const bag::TransformTree& tree,
                                                const std::string& sensor,
                                                const std::string& vehicle,
                                                std::string_view source);

/// Returns the stated mount, its missing figures filled with those of `mount`.
[[nodiscard]] MountOptions filled_in(MountOptions stated, const mount::Mount& mount);

}  // namespace terracut::cli
