// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "pipeline/publish/labelled_frame.hpp"
#include "topic_writer.hpp"

namespace terracut::dds {

/// Publishes the free way of frames as a scan (sensor_msgs/LaserScan), as the polygon of the free
/// area (geometry_msgs/PolygonStamped), and as a grid (nav_msgs/OccupancyGrid). Nothing is made for
/// a topic without readers. One thread.
class FreeWayWriter {
 public:
  /// `scan` is a topic from dds_topic(); the others are below it. Fails with the errors of
  /// TopicWriter::open().
  [[nodiscard]] static Expected<FreeWayWriter> open(const Participant& participant,
                                                    const std::string& scan,
                                                    const Quality& quality);

  /// Publishes a frame's free way, in the frame `frame_id`. Fails with kWriteFailed.
  [[nodiscard]] Status write(const publish::LabelledFrame& frame, std::string& frame_id);
  /// True if a topic has a reader. For any thread.
  [[nodiscard]] bool has_readers() const {
    return scan_.readers() + polygon_.readers() + grid_.readers() > 0;
  }

 private:
  FreeWayWriter(TopicWriter scan, TopicWriter polygon, TopicWriter grid) noexcept
      : scan_(std::move(scan)), polygon_(std::move(polygon)), grid_(std::move(grid)) {}
  [[nodiscard]] Status write_scan(const publish::LabelledFrame& frame, std::string& frame_id);
  [[nodiscard]] Status write_polygon(const publish::LabelledFrame& frame, std::string& frame_id);
  [[nodiscard]] Status write_grid(const publish::LabelledFrame& frame, std::string& frame_id);

  TopicWriter scan_, polygon_, grid_;
};

}  // namespace terracut::dds
