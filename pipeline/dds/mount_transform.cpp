// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "mount_transform.hpp"

#include "calib/mount/mount_pose.hpp"
#include "ros_time.hpp"
#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::dds {

Status write_mount(TopicWriter& tf_static, const mount::Mount& mount, std::string sensor_frame,
                   std::string vehicle_frame) {
  const auto [at_m, turned] = mount::vehicle_in_lidar(mount);
  geometry_msgs_msg_dds__TransformStamped_ transform{
      {ros_time(measure::realtime_ns()), sensor_frame.data()},
      vehicle_frame.data(),
      {{at_m[0], at_m[1], at_m[2]}, {turned[0], turned[1], turned[2], turned[3]}}};
  const tf2_msgs_msg_dds__TFMessage_ message{{1, 1, &transform, false}};
  return tf_static.write(&message);
}

}  // namespace terracut::dds
