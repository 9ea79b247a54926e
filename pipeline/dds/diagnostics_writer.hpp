// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "pipeline/publish/diagnosis.hpp"
#include "topic_writer.hpp"

namespace terracut::dds {

/// Publishes the state of a run on /diagnostics (diagnostic_msgs/DiagnosticArray). One thread.
class DiagnosticsWriter {
 public:
  explicit DiagnosticsWriter(TopicWriter writer) noexcept : writer_(std::move(writer)) {}

  /// To be called about once a second. kWriteFailed.
  [[nodiscard]] Status write(const status::MonitorSnapshot& figures);

 private:
  TopicWriter writer_;
  publish::Diagnoses diagnoses_;
};

}  // namespace terracut::dds
