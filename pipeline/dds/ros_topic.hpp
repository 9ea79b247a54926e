// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace terracut::dds {

/// Returns the DDS topic of a ROS 2 topic name: "/points_raw" is "rt/points_raw", and "~/points" of
/// node "terracut" is "rt/terracut/points"; a name without "/" or "~/" is taken as below "/".
/// Returns nothing for an invalid name: parts are separated by '/', consist of letters, digits and
/// '_', and do not begin with a digit.
[[nodiscard]] std::optional<std::string> dds_topic(std::string_view name, std::string_view node);

}  // namespace terracut::dds
