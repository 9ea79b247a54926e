// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "node_news.hpp"
#include "pipeline/status/deadline_monitor.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tools/cli/live/figures_display.hpp"
#include "tools/cli/live/live_service.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Judges the clouds of a node and shows the node's figures. For the main thread.
class NodeWatch {
 public:
  /// `news` must outlive this object.
  NodeWatch(const Options& options, const std::string& input, NodeNews& news);

  /// Shows what is new. `lost` is the number of clouds that were sent but not received.
  void work_round(std::uint64_t lost);
  void note_interruption() { monitor_.snapshot().interrupted = 1; }
  /// Shows the last figures; call it after the node's threads have ended.
  void last_round() { work_round(lost_); }

  [[nodiscard]] const status::MonitorSnapshot& figures() const noexcept {
    return monitor_.snapshot();
  }
  /// Explains why a node has labelled nothing.
  [[nodiscard]] std::string why_no_frames() const;

 private:
  /// Reports once how many clouds per second the node can answer.
  void look_at_pace(const status::FrameRecord& record);
  void show_input(const NodeNews::State& state, status::MonitorSnapshot& figures);

  NodeNews& news_;
  memory::FixedMemory memory_;
  status::DeadlineMonitor monitor_;
  FiguresDisplay display_;
  LiveService service_;
  std::uint64_t lost_ = 0;
  std::vector<std::int64_t> paces_ns_;  ///< For the first clouds: time from queue to labels.
};

}  // namespace terracut::cli
