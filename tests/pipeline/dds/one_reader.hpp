// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "pipeline/dds/participant.hpp"

namespace terracut::dds {

/// Reads one message of a topic; the memory is the reader's until the end.
template <class Message>
class OneReader {
 public:
  OneReader(const Participant& participant, const std::string& topic,
            const dds_topic_descriptor_t& type, const dds_qos_t* qos = nullptr)
      : topic_(dds_create_topic(participant.id(), &type, topic.c_str(), nullptr, nullptr)),
        reader_(dds_create_reader(participant.id(), topic_.id(), qos, nullptr)) {}
  OneReader(const OneReader&) = delete;
  OneReader& operator=(const OneReader&) = delete;
  ~OneReader() { (void)dds_return_loan(reader_.id(), &sample_, 1); }

  /// Returns null if nothing came for ten seconds.
  const Message* take() {
    const Entity set(dds_create_waitset(dds_get_participant(reader_.id())));
    const Entity condition(dds_create_readcondition(reader_.id(), DDS_ANY_STATE));
    (void)dds_waitset_attach(set.id(), condition.id(), 0);
    if (dds_waitset_wait(set.id(), nullptr, 0, DDS_SECS(10)) < 1) return nullptr;
    dds_sample_info_t info{};
    const bool is_taken = dds_take(reader_.id(), &sample_, &info, 1, 1) == 1 && info.valid_data;
    return is_taken ? static_cast<const Message*>(sample_) : nullptr;
  }

 private:
  Entity topic_, reader_;
  void* sample_ = nullptr;
};

}  // namespace terracut::dds
