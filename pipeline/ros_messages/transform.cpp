// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ros_messages/transform.hpp"

#include "calib/mount/mount_pose.hpp"
#include "pipeline/ros_messages/header.hpp"

namespace terracut::ros_messages {

void write_mount_transform(std::int64_t stamp_ns, const publish::RunFacts& facts,
                           std::vector<std::byte>& message) {
  CdrWriter to(message);
  to.add_length(1);
  add_header(to, stamp_ns, facts.sensor_frame_id);
  to.add(std::string_view(facts.frame_id));
  const mount::Pose pose = mount::vehicle_in_lidar(facts.mount);
  for (const double metres : pose.translation_m) to.add(metres);
  for (const double part : pose.rotation_xyzw) to.add(part);
}

}  // namespace terracut::ros_messages
