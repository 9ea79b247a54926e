// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calib/mount/mount.hpp"

namespace terracut::bag {

/// The transforms that do not change, /tf_static. Frames are named without a slash before them.
class TransformTree {
 public:
  static constexpr std::string_view kTopic = "/tf_static";
  static constexpr std::string_view kType = "tf2_msgs/msg/TFMessage";

  /// Adds the transforms of a message, up to a fault in it. Transforms that are none (not finite)
  /// are left out; those of a frame that had another one count no more, neither of the two.
  void add(std::span<const std::byte> message);
  /// Sets the pose of `child` in `parent`, in place of an earlier one; nothing if it is not finite.
  void set(std::string_view parent, std::string_view child,
           const std::array<double, 3>& translation, const std::array<double, 4>& rotation_xyzw);

  [[nodiscard]] bool is_empty() const noexcept { return parents_.empty(); }
  /// Returns the names of all frames, sorted.
  [[nodiscard]] std::vector<std::string> frames() const;
  /// Returns the transform that takes a point from the frame `from` to the frame `to`; nothing if
  /// the tree does not join them.
  [[nodiscard]] std::optional<mount::RigidTransform> transform(const std::string& from,
                                                               const std::string& to) const;

 private:
  struct Parent {
    std::string frame;
    mount::RigidTransform T_parent_child;
    bool is_certain = true;
  };

  /// Returns the frame's ancestors, itself first, with the transforms to them.
  [[nodiscard]] std::vector<std::pair<std::string, mount::RigidTransform>> ancestors(
      const std::string& frame) const;

  std::map<std::string, Parent> parents_;  ///< By the name of the child.
};

/// Returns a frame's name as TransformTree has it.
[[nodiscard]] std::string frame_name(std::string_view frame_id);

}  // namespace terracut::bag
