// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/status/monitor_snapshot.hpp"

namespace terracut::publish {

/// The present state of one part of a run, in the form of diagnostic_msgs/DiagnosticStatus.
struct Diagnosis {
  enum class Severity : std::uint8_t { kOk = 0, kWarn = 1, kError = 2, kStale = 3 };

  Severity level = Severity::kOk;
  std::string name{};         ///< "terracut: deadline"
  std::string message{};      ///< The state in words for people.
  std::string hardware_id{};  ///< Name of the sensor.
  std::vector<std::pair<std::string, std::string>> values{};
};

/// Judges the figures of a run, about once a second: a loss is a warning only in the second in
/// which it happened. For one thread.
class Diagnoses {
 public:
  /// Returns one diagnosis each for deadline, input, losses, clock, threads and mount, and for the
  /// sensor's view if it is watched.
  [[nodiscard]] std::vector<Diagnosis> of(const status::MonitorSnapshot& figures);

 private:
  std::uint64_t lost_before_ = 0, unclear_before_ = 0;
};

}  // namespace terracut::publish
