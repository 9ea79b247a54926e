// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pipeline/publish/run_facts.hpp"

namespace terracut::ros_messages {

/// Writes a tf2_msgs/TFMessage to `message`, replacing its content: the pose of the points' frame
/// in the sensor's frame, from the mount.
void write_mount_transform(std::int64_t stamp_ns, const publish::RunFacts& facts,
                           std::vector<std::byte>& message);

}  // namespace terracut::ros_messages
