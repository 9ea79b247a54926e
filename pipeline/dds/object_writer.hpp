// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "calib/mount/mount.hpp"
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

  /// Where and when objects were seen.
  struct Seen {
    std::string& frame_id;
    std::int64_t stamp_ns;
    /// Takes places of the vehicle frame to `frame_id`; null: that is the vehicle frame.
    const mount::RigidTransform* T_frame_vehicle = nullptr;
  };
  /// Publishes objects, numbered from 1. Fails with kWriteFailed, as do the next functions.
  [[nodiscard]] Status write(std::span<const objects::Object> objects, const Seen& seen);
  /// Publishes a frame's objects, which lie in the frame `frame_id`.
  [[nodiscard]] Status write(const publish::LabelledFrame& frame, std::string& frame_id);
  /// Publishes the objects that are complete since a sector, if any; the id of a box is the number
  /// of its first return in the frame, its stamp that of its last return.
  [[nodiscard]] Status write(const publish::LabelledSector& sector, std::string& frame_id);
  /// True if boxes or markers have a reader. For any thread.
  [[nodiscard]] bool has_readers() const { return boxes_.readers() + markers_.readers() > 0; }

 private:
  ObjectWriter(TopicWriter boxes, TopicWriter markers) noexcept
      : boxes_(std::move(boxes)), markers_(std::move(markers)) {}
  [[nodiscard]] Status write_markers(std::span<const objects::Object> objects, const Seen& seen);

  TopicWriter boxes_, markers_;
  std::optional<TopicWriter> sector_boxes_;
};

}  // namespace terracut::dds
