// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string_view>
#include <vector>

#include "pipeline/publish/diagnosis.hpp"
#include "pipeline/publish/frame_sink.hpp"
#include "pipeline/publish/run_facts.hpp"
#include "server.hpp"

namespace terracut::cli {

/// Sends labelled frames, diagnostics and the mount's transform to viewers as they come. A message
/// that no viewer has subscribed to is not made.
class FoxgloveSink final : public publish::FrameSink {
 public:
  FoxgloveSink(FoxgloveServer server, publish::RunFacts facts);

  [[nodiscard]] std::string_view name() const noexcept override { return "foxglove"; }
  [[nodiscard]] Status put(const publish::LabelledFrame& frame) override;
  [[nodiscard]] Status put_figures(const status::MonitorSnapshot& figures) override;
  [[nodiscard]] std::vector<status::NamedCount> losses() const override;

 private:
  FoxgloveServer server_;
  publish::RunFacts facts_;
  publish::Diagnoses diagnoses_;
};

}  // namespace terracut::cli
