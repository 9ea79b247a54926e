// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string>

#include "pipeline/publish/labelled_frame.hpp"
#include "topic_writer.hpp"

namespace terracut::dds {

/// Publishes the objects of frames as boxes (vision_msgs/Detection3DArray), and as lines for
/// viewers (visualization_msgs/MarkerArray). Nothing is made for a topic without readers. One
/// thread.
class ObjectWriter {
 public:
  /// Topics from dds_topic(). Fails with the errors of TopicWriter::open().
  [[nodiscard]] static Expected<ObjectWriter> open(const Participant& participant,
                                                   const std::string& boxes,
                                                   const std::string& markers,
                                                   const Quality& quality);

  /// Publishes a frame's objects, which lie in the frame `frame_id`. Fails with kWriteFailed.
  [[nodiscard]] Status write(const publish::LabelledFrame& frame, std::string& frame_id);

 private:
  ObjectWriter(TopicWriter boxes, TopicWriter markers) noexcept
      : boxes_(std::move(boxes)), markers_(std::move(markers)) {}
  [[nodiscard]] Status write_boxes(const publish::LabelledFrame& frame, std::string& frame_id);
  [[nodiscard]] Status write_markers(const publish::LabelledFrame& frame, std::string& frame_id);

  TopicWriter boxes_, markers_;
};

}  // namespace terracut::dds
