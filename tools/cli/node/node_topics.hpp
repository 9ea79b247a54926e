// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <span>

#include "firmware_io/frame/label.hpp"
#include "pipeline/dds/cloud_reader.hpp"
#include "pipeline/dds/derived_cloud.hpp"
#include "pipeline/dds/object_writer.hpp"
#include "pipeline/dds/participant.hpp"
#include "pipeline/dds/topic_writer.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// The topics to which answers are written. For one thread, but for wants_objects().
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
  /// Writes the objects of a cloud.
  [[nodiscard]] Status write(std::span<const objects::Object> objects,
                             const dds::ObjectWriter::Seen& seen) {
    return objects_->write(objects, seen);
  }
  /// True if somebody reads objects. For any thread.
  [[nodiscard]] bool wants_objects() const { return objects_ && objects_->has_readers(); }

 private:
  NodeAnswers() = default;
  [[nodiscard]] static bool is_read(const std::optional<dds::TopicWriter>& writer) {
    return writer && writer->readers() > 0;
  }

  std::optional<dds::TopicWriter> points_, ground_, obstacles_, road_;
  std::optional<dds::TopicWriter> processing_time_, cyclic_time_;
  std::optional<dds::ObjectWriter> objects_;  ///< Exists if objects are asked for.
  dds::DerivedCloud derived_;
};

/// Returns a writer for the topic; none if the topic's name is empty.
[[nodiscard]] Expected<std::optional<dds::TopicWriter>> open_writer(
    const dds::Participant& participant, const std::string& name, const dds::MessageType& type,
    const DdsOptions& options);

}  // namespace terracut::cli
