// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/bag/topic_choice.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "firmware_io/bag/packet_messages.hpp"

namespace terracut::bag {
namespace {

bool is_candidate(const Topic& topic, Content content) {
  const bool is_packets = holds_packets(topic.type) && !topic.name.ends_with("imu_packets");
  return (content != Content::kClouds && is_packets) ||
         (content != Content::kPackets && holds_clouds(topic.type));
}

/// Lists the topics with this content; a hostile bag may have thousands of long names.
std::string list_of(const std::vector<Topic>& topics, Content content) {
  constexpr std::size_t kLongestList = 600;
  std::string list;
  for (const Topic& topic : topics) {
    if (!is_candidate(topic, content)) continue;
    if (list.size() > kLongestList) return list + ", ...";
    list += fmt::format("{}{:.100} ({:.100})", list.empty() ? "" : ", ", topic.name, topic.type);
  }
  return list.empty() ? "none" : list;
}

std::string_view name_of(Content content) {
  return content == Content::kPackets  ? "packets"
         : content == Content::kClouds ? "clouds"
                                       : "packets or clouds";
}

}  // namespace

bool holds_clouds(std::string_view type) noexcept {
  return type == "sensor_msgs/msg/PointCloud2";
}

Expected<std::size_t> choose_topic(const Bag& bag, std::string_view wanted, Content content) {
  const std::vector<Topic>& topics = bag.topics();
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < topics.size(); ++i) {
    const bool is_named = wanted.empty() || topics[i].name == wanted;
    if (is_named && is_candidate(topics[i], content)) found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  const std::string list = list_of(topics, content);
  if (!wanted.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: --topic {}: expected one of its topics with {}: {}", bag.name(),
                            wanted, name_of(content), list));
  }
  if (found.size() > 1) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: several topics hold {}; choose one by --topic: {}", bag.name(),
                            name_of(content), list));
  }
  const std::string others = list_of(topics, Content::kEither);
  return fail(ErrorCode::kUnsupported,
              fmt::format("{}: none of its {} topics holds {}{}", bag.name(), topics.size(),
                          name_of(content),
                          others == "none" ? ""
                                           : "; there are " + others +
                                                 (content == Content::kPackets
                                                      ? "; `terracut segment` labels clouds"
                                                      : "; `terracut replay` labels packets")));
}

}  // namespace terracut::bag
