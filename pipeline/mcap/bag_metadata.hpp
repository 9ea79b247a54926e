// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/mcap/mcap_file.hpp"

namespace terracut::mcap {

/// How a topic is published when rosbag2 plays a recording.
enum class Qos : std::uint8_t {
  kReliable,  ///< The last ten, reliable, volatile.
  kLatched,   ///< The last one, also for those who come later, as static transforms are.
};
/// As rosbag2 writes `offered_qos_profiles` up to version 8 of its metadata, which every later one
/// reads.
[[nodiscard]] std::string offered_qos_of(Qos qos);

/// A file of a bag, as it was when it was closed.
struct BagFile {
  std::string name;  ///< In the bag's folder.
  McapFile::Span span;
  std::vector<std::uint64_t> messages;  ///< By channel.
};

/// The content of a bag's metadata.yaml (rosbag2, version 5), by which `ros2 bag` opens its folder.
[[nodiscard]] std::string bag_metadata(const std::vector<Channel>& channels,
                                       const std::vector<BagFile>& files);

}  // namespace terracut::mcap
