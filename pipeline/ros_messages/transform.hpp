// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pipeline/publish/run_facts.hpp"

namespace terracut::ros_messages {

/// tf2_msgs/TFMessage in place of what is in `message`: where the points' frame lies in the
/// sensor's, by the mount.
void write_mount_transform(std::int64_t stamp_ns, const publish::RunFacts& facts,
                           std::vector<std::byte>& message);

}  // namespace terracut::ros_messages
