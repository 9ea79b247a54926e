// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "ros_topic.hpp"

#include <fmt/format.h>

namespace terracut::dds {
namespace {

bool is_name(std::string_view name) {
  bool begins = true;
  for (const char c : name) {
    const bool digit = c >= '0' && c <= '9';
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    const bool stroke = c == '/';
    if (!(letter || (digit && !begins) || (stroke && !begins))) return false;
    begins = stroke;
  }
  return !begins;
}

std::string_view without_root(std::string_view name) {
  if (name.starts_with('/')) name.remove_prefix(1);
  return name;
}

}  // namespace

std::optional<std::string> dds_topic(std::string_view name, std::string_view node) {
  std::string topic(without_root(name));
  if (name.starts_with("~/")) topic = fmt::format("{}/{}", without_root(node), name.substr(2));
  constexpr std::size_t kLongest = 240;  // limit of ROS
  if (!is_name(topic) || topic.size() > kLongest) return std::nullopt;
  return "rt/" + topic;
}

}  // namespace terracut::dds
