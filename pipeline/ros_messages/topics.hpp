// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "pipeline/publish/run_facts.hpp"
#include "pipeline/ros_messages/free_way_messages.hpp"
#include "pipeline/ros_messages/object_messages.hpp"
#include "pipeline/ros_messages/point_cloud.hpp"
#include "pipeline/ros_messages/schemas.hpp"

namespace terracut::ros_messages {

/// A topic that ROS' tools can show.
struct Topic {
  std::string_view name;
  const Schema& schema;
  /// Writes a frame's message, replacing the content of `message`; null: not sent per frame.
  void (*write)(const publish::LabelledFrame& frame, std::string_view frame_id,
                std::vector<std::byte>& message);
  std::optional<CloudOf> cloud{};  ///< The cloud that it writes, if it does.
};

template <CloudOf kWhich>
void write_cloud(const publish::LabelledFrame& frame, std::string_view frame_id,
                 std::vector<std::byte>& message) {
  write_point_cloud(frame, kWhich, frame_id, message);
}

inline constexpr std::size_t kDiagnosticsTopic = 4, kTransformsTopic = 5;
inline constexpr std::array<Topic, 11> kTopics{
    Topic{"/terracut/points", kPointCloud2, write_cloud<CloudOf::kAll>, CloudOf::kAll},
    Topic{"/terracut/ground", kPointCloud2, write_cloud<CloudOf::kGround>, CloudOf::kGround},
    Topic{"/terracut/obstacles", kPointCloud2, write_cloud<CloudOf::kObstacles>,
          CloudOf::kObstacles},
    Topic{"/terracut/road", kPointCloud2, write_cloud<CloudOf::kRoad>, CloudOf::kRoad},
    Topic{"/diagnostics", kDiagnosticArray, nullptr},
    Topic{"/tf_static", kTfMessage, nullptr},
    Topic{"/terracut/objects", kDetection3DArray, write_detections},
    Topic{"/terracut/objects/markers", kMarkerArray, write_object_markers},
    Topic{"/terracut/free_way", kLaserScan, write_free_way_scan},
    Topic{"/terracut/free_way/polygon", kPolygonStamped, write_free_way_polygon},
    Topic{"/terracut/free_way/grid", kOccupancyGrid, write_free_way_grid}};

/// True if a run makes messages of the topic.
[[nodiscard]] constexpr bool is_made(const Topic& topic, const publish::RunFacts& facts) noexcept {
  if (&topic.schema == &kDetection3DArray || &topic.schema == &kMarkerArray) {
    return facts.found.objects;
  }
  if (&topic.schema == &kLaserScan || &topic.schema == &kPolygonStamped ||
      &topic.schema == &kOccupancyGrid) {
    return facts.found.free_way;
  }
  if (&topic.schema == &kTfMessage) return !facts.sensor_frame_id.empty();
  return topic.cloud != CloudOf::kRoad || facts.has_road;
}

/// Returns the time (CLOCK_REALTIME) at which a frame counts as published: when its labels were
/// ready or, in recordings, when its last packet came.
[[nodiscard]] constexpr std::int64_t publish_time_ns_of(
    const status::FrameRecord& record) noexcept {
  return record.labels_ns != 0 ? record.labels_ns : record.info.last_packet_ns;
}

}  // namespace terracut::ros_messages
