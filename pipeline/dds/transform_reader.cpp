// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "transform_reader.hpp"

#include <array>
#include <span>

#include "ros_types.h"

namespace terracut::dds {
namespace {

void add(const tf2_msgs_msg_dds__TFMessage_& message, bag::TransformTree& tree) {
  const auto& all = message.transforms;
  for (const auto& [header, child, pose] : std::span(all._buffer, all._length)) {
    const auto& [t, q] = pose;
    tree.set(header.frame_id, child, {t.x, t.y, t.z}, {q.x, q.y, q.z, q.w});
  }
}

}  // namespace

Expected<TransformReader> TransformReader::open(const Participant& participant,
                                                const std::string& topic) {
  constexpr int kKept = 100;  // as tf2's own listener keeps
  return TopicReader::open(participant, topic, kTfMessage,
                           {.reliable = true, .depth = kKept, .latched = true})
      .map([](TopicReader&& reader) { return TransformReader(std::move(reader)); });
}

const bag::TransformTree& TransformReader::tree() {
  while (true) {
    std::array<void*, 1> taken{nullptr};
    std::array<dds_sample_info_t, 1> info{};
    if (dds_take(reader_.id(), taken.data(), info.data(), 1, 1) != 1) return tree_;
    if (info[0].valid_data) add(*static_cast<tf2_msgs_msg_dds__TFMessage_*>(taken[0]), tree_);
    (void)dds_return_loan(reader_.id(), taken.data(), 1);
  }
}

}  // namespace terracut::dds
