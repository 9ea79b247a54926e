// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <string>

#include "participant.hpp"
#include "rt/error.hpp"

namespace terracut::dds {

/// A type of ros_types.idl, and what ROS 2 calls its hash (RIHS01, of the type's description:
/// tests/pipeline/dds/type_hash_test.py computes it); null where that is not known.
struct MessageType {
  const dds_topic_descriptor_t* descriptor;
  const char* hash;
};
extern const MessageType kPointCloud2, kDiagnosticArray, kTfMessage, kFloat64Stamped;

/// What is offered to readers. Reliable and volatile suits those of ROS 2 by either of its usual
/// profiles, SensorDataQoS and the default.
struct Quality {
  bool reliable = true;
  int depth = 5;         ///< Messages that are kept for readers that have not acknowledged them.
  bool latched = false;  ///< TRANSIENT_LOCAL: readers that come later get the last `depth`.
};

/// Writes messages of one topic. One thread at a time.
class TopicWriter {
 public:
  /// `topic`: of dds_topic().
  [[nodiscard]] static Expected<TopicWriter> open(const Participant& participant,
                                                  const std::string& topic, const MessageType& type,
                                                  const Quality& quality);

  /// `message`: of the type. kWriteFailed.
  [[nodiscard]] Status write(const void* message);
  /// Waits until every reliable reader has acknowledged all that was written, at most so long.
  [[nodiscard]] bool is_acknowledged(std::int64_t patience_ns);
  /// How many readers there are now.
  [[nodiscard]] std::uint32_t readers() const;

 private:
  TopicWriter(Entity topic, Entity writer, std::string name) noexcept
      : topic_(std::move(topic)), writer_(std::move(writer)), name_(std::move(name)) {}

  Entity topic_;
  Entity writer_;  ///< After its topic, so that it goes before it.
  std::string name_;
};

}  // namespace terracut::dds
