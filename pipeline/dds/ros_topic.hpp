// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace terracut::dds {

/// The DDS topic behind the name of a ROS 2 topic: "/points_raw" is "rt/points_raw", and "~/points"
/// of node "terracut" is "rt/terracut/points"; a name without either is below "/". Nothing for what
/// is no name: parts of letters, digits and '_' that begin with no digit, '/' between them.
[[nodiscard]] std::optional<std::string> dds_topic(std::string_view name, std::string_view node);

}  // namespace terracut::dds
