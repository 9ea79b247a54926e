// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "bag_pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware_io/bag/cdr_reader.hpp"
#include "firmware_io/bag/transform_tree.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/input/mount_choice.hpp"
#include "tools/cli/input/tree_mount.hpp"

namespace terracut::cli {
namespace {

/// Frames that are no sensor's.
constexpr std::array<std::string_view, 3> kWorldFrames{"map", "odom", "earth"};

bool is_world_frame(std::string_view frame) {
  return std::ranges::find(kWorldFrames, frame) != kWorldFrames.end();
}

/// The beginning of a bag: its static transforms, and the frame of a topic.
struct Beginning {
  bag::TransformTree tree;
  std::string frame;

  Beginning(bag::Bag& bag, std::size_t topic) {
    constexpr std::int64_t kSearched_ns = 10'000'000'000;
    const std::vector<bag::Topic>& topics = bag.topics();
    std::vector<bool> wanted(topics.size());
    for (std::size_t i = 0; i < topics.size(); ++i) {
      wanted[i] = i == topic || (topics[i].name == bag::TransformTree::kTopic &&
                                 topics[i].type == bag::TransformTree::kType);
    }
    std::optional<std::int64_t> first_ns;
    for (auto found = bag.next(wanted); found && *found; found = bag.next(wanted)) {
      const bag::Message& message = (*found)->message;
      if (message.topic != topic) {
        tree.add(message.bytes);
        continue;
      }
      if (frame.empty()) {
        bag::CdrReader from(message.bytes);
        frame = bag::frame_name(bag::Header::read(from).frame_id);
      }
      if (message.stamp_ns - first_ns.value_or(message.stamp_ns) > kSearched_ns) break;
      if (!first_ns) first_ns = message.stamp_ns;
    }
    (void)bag.seek({});
  }
};

constexpr std::string_view kSource = "the bag's /tf_static";

void take(TreeMount found, BagPose& pose) {
  pose.mount = found.mount;
  pose.note = std::move(found.note);
}

}  // namespace

BagPose pose_in(bag::Bag& bag, std::size_t topic) {
  const Beginning beginning(bag, topic);
  const bag::TransformTree& tree = beginning.tree;
  BagPose pose;
  if (tree.is_empty()) return pose;
  pose.note = fmt::format(
      "mount: the bag's /tf_static does not say how the sensor stands (frame '{:.100}')",
      beginning.frame);
  if (!is_vehicle_frame(beginning.frame)) {
    if (auto found = mount_in(tree, beginning.frame, "", kSource)) take(*std::move(found), pose);
    return pose;
  }
  std::vector<std::string> sensors = tree.frames();
  std::erase_if(sensors, [](const std::string& frame) {
    return is_vehicle_frame(frame) || is_world_frame(frame);
  });
  if (sensors.size() != 1) return pose;
  pose.T_points_sensor = tree.transform(sensors.front(), beginning.frame);
  if (pose.T_points_sensor) {
    take(mount_by(*pose.T_points_sensor, sensors.front(), beginning.frame, kSource), pose);
  }
  return pose;
}

MountOptions stated_or_of_bag(MountOptions stated, const BagPose& pose) {
  if (!is_mount_open(stated)) return stated;
  if (!pose.note.empty()) say(pose.note);
  return pose.mount ? filled_in(std::move(stated), *pose.mount) : stated;
}

}  // namespace terracut::cli
