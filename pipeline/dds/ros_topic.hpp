// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace terracut::dds {

/// Returns the DDS topic of a ROS 2 topic name: "/points_raw" is "rt/points_raw", and "~/points" of
/// node "terracut" is "rt/terracut/points"; a name with neither prefix is below "/". Nothing for an
/// invalid name: parts must be of letters, digits and '_', begin with no digit, and be separated by
/// '/'.
[[nodiscard]] std::optional<std::string> dds_topic(std::string_view name, std::string_view node);

}  // namespace terracut::dds
