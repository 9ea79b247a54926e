// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <utility>

#include "participant.hpp"
#include "rt/error.hpp"
#include "topic_writer.hpp"

namespace terracut::dds {

/// A reader of one topic, for others to take messages from.
class TopicReader {
 public:
  /// `topic` is from dds_topic(). Hears only writers that offer at least `quality`, and keeps its
  /// depth of messages until they are taken.
  [[nodiscard]] static Expected<TopicReader> open(const Participant& participant,
                                                  const std::string& topic, const MessageType& type,
                                                  const Quality& quality);

  [[nodiscard]] dds_entity_t id() const noexcept { return reader_.id(); }

 private:
  TopicReader(Entity topic, Entity reader) noexcept
      : topic_(std::move(topic)), reader_(std::move(reader)) {}

  Entity topic_;
  Entity reader_;  ///< Declared after its topic, so that it is deleted first.
};

}  // namespace terracut::dds
