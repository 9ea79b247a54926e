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
  struct Topics {
    std::string boxes, markers, sector_boxes;  ///< From dds_topic(); the last may be empty.
  };

  /// Fails with the errors of TopicWriter::open().
  [[nodiscard]] static Expected<ObjectWriter> open(const Participant& participant,
                                                   const Topics& topics, const Quality& quality);

  /// Publishes a frame's objects, which lie in the frame `frame_id`. Fails with kWriteFailed, as
  /// does the next function.
  [[nodiscard]] Status write(const publish::LabelledFrame& frame, std::string& frame_id);
  /// Publishes the objects that are complete since a sector, if any; the id of a box is the number
  /// of its first return in the frame, its stamp that of its last return.
  [[nodiscard]] Status write(const publish::LabelledSector& sector, std::string& frame_id);

 private:
  ObjectWriter(TopicWriter boxes, TopicWriter markers) noexcept
      : boxes_(std::move(boxes)), markers_(std::move(markers)) {}
  [[nodiscard]] Status write_markers(const publish::LabelledFrame& frame, std::string& frame_id);

  TopicWriter boxes_, markers_;
  std::optional<TopicWriter> sector_boxes_;
};

}  // namespace terracut::dds
