// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "pipeline/publish/diagnosis.hpp"
#include "topic_writer.hpp"

namespace terracut::dds {

/// Publishes the state of a run on /diagnostics (diagnostic_msgs/DiagnosticArray), by one thread.
class DiagnosticsWriter {
 public:
  explicit DiagnosticsWriter(TopicWriter writer) noexcept : writer_(std::move(writer)) {}

  /// Publishes `figures`; call it about once a second. Fails with kWriteFailed.
  [[nodiscard]] Status write(const status::MonitorSnapshot& figures);

 private:
  TopicWriter writer_;
  publish::Diagnoses diagnoses_;
};

}  // namespace terracut::dds
