// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "pipeline/publish/labelled_frame.hpp"
#include "pipeline/status/monitor_snapshot.hpp"
#include "pipeline/status/named_count.hpp"
#include "rt/error.hpp"

namespace terracut::publish {

/// An output of labelled frames. All functions but name(), queue_frames() and losses() are called
/// on one thread of its own without a deadline (Publisher), which they may block for any time.
class FrameSink {
 public:
  FrameSink() = default;
  FrameSink(const FrameSink&) = delete;
  FrameSink& operator=(const FrameSink&) = delete;
  virtual ~FrameSink() = default;

  /// Returns a stable lower_snake_case name, as in figures: "mcap".
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  /// Returns how many frames may wait for it, >= 1. More help if it stalls at times, as disks do.
  [[nodiscard]] virtual std::size_t queue_frames() const noexcept { return 2; }

  /// Takes a frame, valid during the call. After an error nothing more is called, not even
  /// finish().
  [[nodiscard]] virtual Status put(const LabelledFrame& frame) = 0;
  /// Takes the run's figures, about once a second. Errors as of put().
  [[nodiscard]] virtual Status put_figures(const status::MonitorSnapshot& /*figures*/) {
    return {};
  }
  /// Called after the last frame.
  [[nodiscard]] virtual Status finish() { return {}; }

  /// Returns losses of its own since the start, such as frames for its readers, under names that
  /// begin with name(). From any thread.
  [[nodiscard]] virtual std::vector<status::NamedCount> losses() const { return {}; }
};

}  // namespace terracut::publish
