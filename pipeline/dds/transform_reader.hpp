// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <utility>

#include "firmware_io/bag/transform_tree.hpp"
#include "participant.hpp"
#include "rt/error.hpp"
#include "topic_reader.hpp"

namespace terracut::dds {

/// Reads the transforms that do not change, /tf_static. For use by one thread.
class TransformReader {
 public:
  /// `topic` is from dds_topic().
  [[nodiscard]] static Expected<TransformReader> open(const Participant& participant,
                                                      const std::string& topic);

  /// Returns the transforms that have come so far; of a frame the newest.
  [[nodiscard]] const bag::TransformTree& tree();

 private:
  explicit TransformReader(TopicReader reader) noexcept : reader_(std::move(reader)) {}

  TopicReader reader_;
  bag::TransformTree tree_;
};

}  // namespace terracut::dds
