// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <memory>
#include <string>

#include "participant.hpp"
#include "rt/error.hpp"

namespace terracut::dds {

/// A type of ros_types.idl with the hash of its description in ROS 2 (RIHS01), which
/// tests/pipeline/dds/type_hash_test.py computes; the hash is null if unknown.
struct MessageType {
  const dds_topic_descriptor_t* descriptor;
  const char* hash;
};
extern const MessageType kPointCloud2, kDiagnosticArray, kTfMessage, kDetection3DArray,
    kMarkerArray, kLaserScan, kPolygonStamped, kOccupancyGrid, kFloat64Stamped;

/// The quality of service that a writer offers, or a reader asks for. Of writers reliable and
/// volatile suits ROS 2 readers with either usual profile, SensorDataQoS or the default.
struct Quality {
  bool reliable = true;
  int depth = 5;         ///< Messages kept for readers that have not acknowledged or taken them.
  bool latched = false;  ///< TRANSIENT_LOCAL: later readers get the last `depth` messages.
};

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;
[[nodiscard]] Qos qos_of(const MessageType& type, const Quality& quality);

/// Writes messages of one topic. Only one thread may use it at a time.
class TopicWriter {
 public:
  /// `topic` is from dds_topic().
  [[nodiscard]] static Expected<TopicWriter> open(const Participant& participant,
                                                  const std::string& topic, const MessageType& type,
                                                  const Quality& quality);

  /// Publishes `message`, which must have this topic's type. Fails with kWriteFailed.
  [[nodiscard]] Status write(const void* message);
  /// Waits until every reliable reader has acknowledged all messages; false after `patience_ns`.
  [[nodiscard]] bool is_acknowledged(std::int64_t patience_ns);
  /// Returns the current number of readers of the topic.
  [[nodiscard]] std::uint32_t readers() const;

 private:
  TopicWriter(Entity topic, Entity writer, std::string name) noexcept
      : topic_(std::move(topic)), writer_(std::move(writer)), name_(std::move(name)) {}

  Entity topic_;
  Entity writer_;  ///< Declared after its topic, so that it is deleted first.
  std::string name_;
};

}  // namespace terracut::dds
