// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/publish/diagnosis.hpp"

namespace terracut::ros_messages {

/// Writes a diagnostic_msgs/DiagnosticArray to `message`, replacing the content of `message`.
void write_diagnostic_array(std::int64_t stamp_ns, std::span<const publish::Diagnosis> diagnoses,
                            std::vector<std::byte>& message);

}  // namespace terracut::ros_messages
