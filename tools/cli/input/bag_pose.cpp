// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "bag_pose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "calib/beams/angle.hpp"
#include "firmware_io/bag/cdr_reader.hpp"
#include "firmware_io/bag/transform_tree.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {
namespace {

/// Frames whose origin lies on the ground, or (base_link) is taken to.
constexpr std::array<std::string_view, 3> kVehicleFrames{"base_footprint", "base_link",
                                                         "terracut_ground"};
/// Frames that are no sensor's.
constexpr std::array<std::string_view, 3> kWorldFrames{"map", "odom", "earth"};

bool is_one_of(const auto& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
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

/// Returns the mount of a sensor by its transform to a frame on the ground, whose x axis is ahead
/// as the sensor's is taken to be; nothing if it is no mount.
std::optional<mount::Mount> mount_of(const mount::RigidTransform& T_vehicle_sensor) {
  const auto& T = T_vehicle_sensor;
  const mount::Mount mount{T[11], std::atan2(T[9], T[10]), std::asin(std::clamp(-T[8], -1.0, 1.0))};
  const bool is_possible = mount.height_m > 0.2 && mount.height_m < 6;
  return is_possible ? std::optional(mount) : std::nullopt;
}

/// Takes the mount from a sensor's transform to a vehicle's frame.
void take(const mount::RigidTransform& T_vehicle_sensor, const std::string& sensor,
          std::string_view vehicle, BagPose& pose) {
  pose.mount = mount_of(T_vehicle_sensor);
  pose.note = pose.mount ? fmt::format(
                               "mount: {} stands {:.3f} m above {}, roll {:.2f} deg, pitch {:.2f} "
                               "deg, by the bag's /tf_static",
                               sensor, pose.mount->height_m, vehicle,
                               beams::rad_to_deg(pose.mount->roll_rad),
                               beams::rad_to_deg(pose.mount->pitch_rad))
                         : fmt::format(
                               "mount: not taken from the bag's /tf_static, by which {} stands "
                               "{:.3f} m above {}",
                               sensor, T_vehicle_sensor[11], vehicle);
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
  if (!is_one_of(kVehicleFrames, beginning.frame)) {
    for (const std::string_view vehicle : kVehicleFrames) {
      if (const auto T = tree.transform(beginning.frame, std::string(vehicle))) {
        take(*T, beginning.frame, vehicle, pose);
        return pose;
      }
    }
    return pose;
  }
  std::vector<std::string> sensors = tree.frames();
  std::erase_if(sensors, [](const std::string& frame) {
    return is_one_of(kVehicleFrames, frame) || is_one_of(kWorldFrames, frame);
  });
  if (sensors.size() != 1) return pose;
  pose.T_points_sensor = tree.transform(sensors.front(), beginning.frame);
  if (pose.T_points_sensor) take(*pose.T_points_sensor, sensors.front(), beginning.frame, pose);
  return pose;
}

MountOptions stated_or_of_bag(MountOptions stated, const BagPose& pose) {
  const bool is_all_stated =
      !stated.setup.empty() || (stated.height_m && stated.roll_deg && stated.pitch_deg);
  if (is_all_stated) return stated;
  if (!pose.note.empty()) say(pose.note);
  if (!pose.mount) return stated;
  if (!stated.height_m) stated.height_m = pose.mount->height_m;
  if (!stated.roll_deg) stated.roll_deg = beams::rad_to_deg(pose.mount->roll_rad);
  if (!stated.pitch_deg) stated.pitch_deg = beams::rad_to_deg(pose.mount->pitch_rad);
  return stated;
}

}  // namespace terracut::cli
