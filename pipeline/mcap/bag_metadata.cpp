// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/mcap/bag_metadata.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace terracut::mcap {
namespace {

/// Returns the text in double quotes, with line ends escaped.
std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\n') {
      result += "\\n";
      continue;
    }
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

std::uint64_t messages_in(const BagFile& file) {
  return std::accumulate(file.messages.begin(), file.messages.end(), std::uint64_t{0});
}

/// Returns the span from the first message of any file to the last.
McapFile::Span whole_span(const std::vector<BagFile>& files) {
  McapFile::Span whole{std::numeric_limits<std::uint64_t>::max(), 0};
  for (const BagFile& file : files) {
    if (messages_in(file) == 0) continue;
    whole.first_ns = std::min(whole.first_ns, file.span.first_ns);
    whole.last_ns = std::max(whole.last_ns, file.span.last_ns);
  }
  return whole.last_ns < whole.first_ns ? McapFile::Span{} : whole;
}

}  // namespace

std::string offered_qos_of(Qos qos) {
  constexpr std::string_view kForEver = "sec: 9223372036\n    nsec: 854775807";
  const bool is_latched = qos == Qos::kLatched;
  return fmt::format(
      "- history: 1\n  depth: {}\n  reliability: 1\n  durability: {}\n"
      "  deadline:\n    {}\n  lifespan:\n    {}\n  liveliness: 1\n"
      "  liveliness_lease_duration:\n    {}\n  avoid_ros_namespace_conventions: false",
      is_latched ? 1 : 10, is_latched ? 1 : 2, kForEver, kForEver, kForEver);
}

std::string bag_metadata(const std::vector<Channel>& channels, const std::vector<BagFile>& files) {
  const McapFile::Span whole = whole_span(files);
  std::uint64_t messages = 0;
  for (const BagFile& file : files) messages += messages_in(file);
  std::string text = fmt::format(
      "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n"
      "  duration:\n    nanoseconds: {}\n"
      "  starting_time:\n    nanoseconds_since_epoch: {}\n  message_count: {}\n"
      "  topics_with_message_count:\n",
      whole.last_ns - whole.first_ns, whole.first_ns, messages);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    std::uint64_t count = 0;
    for (const BagFile& file : files) count += file.messages[i];
    text += fmt::format(
        "    - topic_metadata:\n        name: {}\n        type: {}\n"
        "        serialization_format: cdr\n        offered_qos_profiles: {}\n"
        "      message_count: {}\n",
        channels[i].topic, channels[i].type, in_quotes(channels[i].offered_qos), count);
  }
  text += "  compression_format: \"\"\n  compression_mode: \"\"\n  relative_file_paths:\n";
  for (const BagFile& file : files) text += fmt::format("    - {}\n", in_quotes(file.name));
  text += "  files:\n";
  for (const BagFile& file : files) {
    text += fmt::format(
        "    - path: {}\n      starting_time:\n        nanoseconds_since_epoch: {}\n"
        "      duration:\n        nanoseconds: {}\n      message_count: {}\n",
        in_quotes(file.name), file.span.first_ns, file.span.last_ns - file.span.first_ns,
        messages_in(file));
  }
  return text;
}

}  // namespace terracut::mcap
