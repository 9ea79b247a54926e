// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "pipeline/dds/participant.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

[[nodiscard]] dds::Participant::Config participant_config_of(const DdsOptions& options);

/// Returns the DDS topic of a ROS name that was checked as a setting; empty for an empty name.
[[nodiscard]] std::string dds_topic_of(const std::string& name, const DdsOptions& options);

/// Lists the topics of clouds for people: "/terracut/points, /terracut/ground".
[[nodiscard]] std::string topic_list(const DdsOptions& options);

}  // namespace terracut::cli
