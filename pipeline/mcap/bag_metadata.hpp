// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/mcap/mcap_file.hpp"

namespace terracut::mcap {

/// The quality of service with which rosbag2 publishes a topic when it plays a recording.
enum class Qos : std::uint8_t {
  kReliable,  ///< Reliable and volatile; keeps the last ten messages.
  kLatched,   ///< Keeps the last message for late readers; for static transforms.
};
/// Returns the text of `offered_qos_profiles` as rosbag2 writes it up to version 8 of its metadata;
/// every later version reads it, too.
[[nodiscard]] std::string offered_qos_of(Qos qos);

/// A closed file of a bag.
struct BagFile {
  std::string name;  ///< Relative to the bag's folder.
  McapFile::Span span;
  std::vector<std::uint64_t> messages;  ///< Number of messages by channel.
};

/// Returns the metadata.yaml (rosbag2, version 5) by which `ros2 bag` opens the bag's folder.
[[nodiscard]] std::string bag_metadata(const std::vector<Channel>& channels,
                                       const std::vector<BagFile>& files);

}  // namespace terracut::mcap
