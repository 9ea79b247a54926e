// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "topic_reader.hpp"

namespace terracut::dds {

Expected<TopicReader> TopicReader::open(const Participant& participant, const std::string& topic,
                                        const MessageType& type, const Quality& quality) {
  Entity named(
      dds_create_topic(participant.id(), type.descriptor, topic.c_str(), nullptr, nullptr));
  if (named.id() < 0) return refused(ErrorCode::kInvalidArgument, "topic " + topic, named.id());
  Entity reader(
      dds_create_reader(participant.id(), named.id(), qos_of(type, quality).get(), nullptr));
  if (reader.id() < 0) {
    return refused(ErrorCode::kInvalidArgument, "a reader of " + topic, reader.id());
  }
  return TopicReader(std::move(named), std::move(reader));
}

}  // namespace terracut::dds
