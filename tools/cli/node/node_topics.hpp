// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <span>
#include <string>

#include "firmware_io/frame/label.hpp"
#include "pipeline/dds/cloud_reader.hpp"
#include "pipeline/dds/derived_cloud.hpp"
#include "pipeline/dds/free_way_writer.hpp"
#include "pipeline/dds/object_writer.hpp"
#include "pipeline/dds/participant.hpp"
#include "pipeline/dds/topic_writer.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// What was found in a cloud beside its labels.
struct NodeScene {
  publish::LabelledFrame frame;  ///< Stamp, objects and free way, in the vehicle frame.
  mount::Mount mount;            ///< Of the sensor above that frame.
  std::string cloud_frame, answer_frame;
  mount::RigidTransform T_answer_vehicle;
};

/// The topics to which answers are written. For one thread, but for wants_scene().
class NodeAnswers {
 public:
  [[nodiscard]] static Expected<NodeAnswers> open(const dds::Participant& participant,
                                                  const Options& options);

  /// The times that are published with the answer to a cloud.
  struct Times {
    double processing_ms = 0;  ///< Time from the cloud's arrival to its labels.
    double cyclic_ms = 0;      ///< Time from the previous labels to these.
  };
  /// Writes an answer; skips topics without readers. Returns the first error.
  [[nodiscard]] Status write(const dds::RosCloud& cloud, std::span<const frame::Label> labels,
                             std::span<const float> heights_m, const Times& times);
  /// Writes the free way in the vehicle frame, which is told to lie below the cloud's, and objects
  /// in the frame of the answers. Returns the first error.
  [[nodiscard]] Status write(NodeScene& scene);
  /// True if somebody reads objects or the free way. For any thread.
  [[nodiscard]] bool wants_scene() const {
    return (objects_ && objects_->has_readers()) || (free_way_ && free_way_->has_readers());
  }

 private:
  NodeAnswers() = default;
  [[nodiscard]] Status open_scene(const dds::Participant& participant, const Options& options);
  [[nodiscard]] static bool is_read(const std::optional<dds::TopicWriter>& writer) {
    return writer && writer->readers() > 0;
  }

  std::optional<dds::TopicWriter> points_, ground_, obstacles_, road_;
  std::optional<dds::TopicWriter> processing_time_, cyclic_time_;
  std::optional<dds::ObjectWriter> objects_;    ///< Exists if objects are asked for.
  std::optional<dds::FreeWayWriter> free_way_;  ///< Exists with the next if it is asked for.
  std::optional<dds::TopicWriter> tf_static_;
  std::string vehicle_frame_;
  bool is_vehicle_frame_told_ = false;
  dds::DerivedCloud derived_;
};

/// Returns a writer for the topic; none if the topic's name is empty.
[[nodiscard]] Expected<std::optional<dds::TopicWriter>> open_writer(
    const dds::Participant& participant, const std::string& name, const dds::MessageType& type,
    const DdsOptions& options);

}  // namespace terracut::cli
