// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "diagnostics_writer.hpp"

#include <string>
#include <vector>

#include "ros_time.hpp"
#include "sequence_of.hpp"

namespace terracut::dds {
namespace {

using KeyValue = diagnostic_msgs_msg_dds__KeyValue_;
using DiagnosticStatus = diagnostic_msgs_msg_dds__DiagnosticStatus_;

}  // namespace

Status DiagnosticsWriter::write(const status::MonitorSnapshot& figures) {
  std::vector<publish::Diagnosis> diagnoses = diagnoses_.of(figures);
  std::vector<std::vector<KeyValue>> values(diagnoses.size());
  std::vector<DiagnosticStatus> states;
  for (std::size_t i = 0; i < diagnoses.size(); ++i) {
    publish::Diagnosis& each = diagnoses[i];
    for (auto& [key, value] : each.values) values[i].push_back({key.data(), value.data()});
    states.push_back({static_cast<std::uint8_t>(each.level), each.name.data(), each.message.data(),
                      each.hardware_id.data(),
                      sequence_of<dds_sequence_diagnostic_msgs_msg_dds__KeyValue_>(values[i])});
  }
  std::string no_frame;
  const diagnostic_msgs_msg_dds__DiagnosticArray_ message{
      {ros_time(figures.taken_ns), no_frame.data()},
      sequence_of<dds_sequence_diagnostic_msgs_msg_dds__DiagnosticStatus_>(states)};
  return writer_.write(&message);
}

}  // namespace terracut::dds
