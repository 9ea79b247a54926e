// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "calib/mount/mount.hpp"
#include "topic_writer.hpp"

namespace terracut::dds {

/// The quality of /tf_static: later readers get the transform, too.
inline constexpr Quality kLatched{.reliable = true, .depth = 1, .latched = true};

/// Tells that the vehicle frame of a mount lies below the frame of its sensor. Fails with
/// kWriteFailed.
[[nodiscard]] Status write_mount(TopicWriter& tf_static, const mount::Mount& mount,
                                 std::string sensor_frame, std::string vehicle_frame);

}  // namespace terracut::dds
