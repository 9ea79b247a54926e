// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/ros_messages/diagnostic_array.hpp"

#include "pipeline/ros_messages/header.hpp"

namespace terracut::ros_messages {

void write_diagnostic_array(std::int64_t stamp_ns, std::span<const publish::Diagnosis> diagnoses,
                            std::vector<std::byte>& message) {
  CdrWriter to(message);
  add_header(to, stamp_ns, "");
  to.add_length(diagnoses.size());
  for (const publish::Diagnosis& diagnosis : diagnoses) {
    to.add(static_cast<std::uint8_t>(diagnosis.level));
    to.add(std::string_view(diagnosis.name));
    to.add(std::string_view(diagnosis.message));
    to.add(std::string_view(diagnosis.hardware_id));
    to.add_length(diagnosis.values.size());
    for (const auto& [key, value] : diagnosis.values) {
      to.add(std::string_view(key));
      to.add(std::string_view(value));
    }
  }
}

}  // namespace terracut::ros_messages
