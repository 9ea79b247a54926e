// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <span>

#include "firmware_io/frame/label.hpp"
#include "pipeline/dds/cloud_reader.hpp"
#include "pipeline/dds/derived_cloud.hpp"
#include "pipeline/dds/participant.hpp"
#include "pipeline/dds/topic_writer.hpp"
#include "rt/error.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Where the answers to clouds go. One thread.
class NodeAnswers {
 public:
  [[nodiscard]] static Expected<NodeAnswers> open(const dds::Participant& participant,
                                                  const Options& options);

  /// What the answer to one cloud took.
  struct Times {
    double processing_ms = 0;  ///< From the cloud's arrival to its labels.
    double cyclic_ms = 0;      ///< From the labels before to these.
  };
  /// Nothing is made of a cloud for a topic that nobody reads. The first error.
  [[nodiscard]] Status write(const dds::RosCloud& cloud, std::span<const frame::Label> labels,
                             const Times& times);

 private:
  NodeAnswers() = default;
  [[nodiscard]] static bool is_read(const std::optional<dds::TopicWriter>& writer) {
    return writer && writer->readers() > 0;
  }

  std::optional<dds::TopicWriter> points_, ground_, obstacles_, road_;
  std::optional<dds::TopicWriter> processing_time_, cyclic_time_;
  dds::DerivedCloud derived_;
};

/// A writer of a topic that is to be published; none where its name is empty.
[[nodiscard]] Expected<std::optional<dds::TopicWriter>> open_writer(
    const dds::Participant& participant, const std::string& name, const dds::MessageType& type,
    const DdsOptions& options);

}  // namespace terracut::cli
