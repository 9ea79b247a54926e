// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <string>

#include "participant.hpp"
#include "rt/error.hpp"

namespace terracut::dds {

/// A type of ros_types.idl with its ROS 2 hash (RIHS01, of the type's description:
/// tests/pipeline/dds/type_hash_test.py computes it); null if the hash is unknown.
struct MessageType {
  const dds_topic_descriptor_t* descriptor;
  const char* hash;
};
extern const MessageType kPointCloud2, kDiagnosticArray, kTfMessage, kFloat64Stamped;

/// The quality of service offered. Reliable and volatile fits ROS 2 readers with either usual
/// profile, SensorDataQoS and the default.
struct Quality {
  bool reliable = true;
  int depth = 5;         ///< Messages kept for readers that have not acknowledged them.
  bool latched = false;  ///< TRANSIENT_LOCAL: later readers get the last `depth` messages.
};

/// Writes messages of one topic. One thread at a time.
class TopicWriter {
 public:
  /// `topic` is from dds_topic().
  [[nodiscard]] static Expected<TopicWriter> open(const Participant& participant,
                                                  const std::string& topic, const MessageType& type,
                                                  const Quality& quality);

  /// `message` must be of the type. kWriteFailed.
  [[nodiscard]] Status write(const void* message);
  /// Waits, at most `patience_ns`, until every reliable reader has acknowledged all messages.
  [[nodiscard]] bool is_acknowledged(std::int64_t patience_ns);
  /// Returns the current number of readers.
  [[nodiscard]] std::uint32_t readers() const;

 private:
  TopicWriter(Entity topic, Entity writer, std::string name) noexcept
      : topic_(std::move(topic)), writer_(std::move(writer)), name_(std::move(name)) {}

  Entity topic_;
  Entity writer_;  ///< Declared after its topic, to be deleted before it.
  std::string name_;
};

}  // namespace terracut::dds
