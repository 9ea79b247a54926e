// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/mcap/mcap_file.hpp"

namespace terracut::mcap {

/// How rosbag2 publishes a topic when it plays a recording.
enum class Qos : std::uint8_t {
  kReliable,  ///< Keeps the last ten; reliable, volatile.
  kLatched,   ///< Keeps the last one for late readers, like static transforms.
};
/// Returns `offered_qos_profiles` as rosbag2 writes them up to version 8 of its metadata, which
/// every later version reads.
[[nodiscard]] std::string offered_qos_of(Qos qos);

/// A closed file of a bag.
struct BagFile {
  std::string name;  ///< Relative to the bag's folder.
  McapFile::Span span;
  std::vector<std::uint64_t> messages;  ///< Indexed by channel.
};

/// Returns a bag's metadata.yaml (rosbag2, version 5), by which `ros2 bag` opens its folder.
[[nodiscard]] std::string bag_metadata(const std::vector<Channel>& channels,
                                       const std::vector<BagFile>& files);

}  // namespace terracut::mcap
