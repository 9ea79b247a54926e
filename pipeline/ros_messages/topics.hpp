// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "pipeline/ros_messages/point_cloud.hpp"
#include "pipeline/ros_messages/schemas.hpp"

namespace terracut::ros_messages {

/// A topic that ROS' tools can show.
struct Topic {
  std::string_view name;
  const Schema& schema;
  std::optional<CloudOf> cloud;  ///< Cloud sent for every frame; none: not sent per frame.
};

inline constexpr std::size_t kDiagnosticsTopic = 4, kTransformsTopic = 5;
inline constexpr std::array<Topic, 6> kTopics{
    Topic{"/terracut/points", kPointCloud2, CloudOf::kAll},
    Topic{"/terracut/ground", kPointCloud2, CloudOf::kGround},
    Topic{"/terracut/obstacles", kPointCloud2, CloudOf::kObstacles},
    Topic{"/terracut/road", kPointCloud2, CloudOf::kRoad},
    Topic{"/diagnostics", kDiagnosticArray, std::nullopt},
    Topic{"/tf_static", kTfMessage, std::nullopt}};

/// Returns the time (CLOCK_REALTIME) at which a frame counts as published: when its labels were
/// ready or, in recordings, when its last packet came.
[[nodiscard]] constexpr std::int64_t publish_time_ns_of(
    const status::FrameRecord& record) noexcept {
  return record.labels_ns != 0 ? record.labels_ns : record.info.last_packet_ns;
}

}  // namespace terracut::ros_messages
