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

/// An output of labelled frames. Publisher calls all functions except name(), queue_frames(),
/// wants_sectors() and losses() on one thread of the output's own without a deadline; they may
/// block for any time.
class FrameSink {
 public:
  FrameSink() = default;
  FrameSink(const FrameSink&) = delete;
  FrameSink& operator=(const FrameSink&) = delete;
  virtual ~FrameSink() = default;

  /// Returns a stable lower_snake_case name for the figures, such as "mcap".
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  /// Returns how many frames may wait for the output, >= 1; more if it stalls at times.
  [[nodiscard]] virtual std::size_t queue_frames() const noexcept { return 2; }

  /// True if the output also takes the sectors of each frame.
  [[nodiscard]] virtual bool wants_sectors() const noexcept { return false; }

  /// Takes a frame, valid during the call. After an error no function of the output is called any
  /// more, not even finish().
  [[nodiscard]] virtual Status put(const LabelledFrame& frame) = 0;
  /// Takes a sector, valid during the call; those of a frame come before the frame. An error ends
  /// the output, as in put().
  [[nodiscard]] virtual Status put_sector(const LabelledSector& /*sector*/) { return {}; }
  /// Takes the run's figures, about once a second. An error ends the output, as in put().
  [[nodiscard]] virtual Status put_figures(const status::MonitorSnapshot& /*figures*/) {
    return {};
  }
  /// Completes the output; called after the last frame.
  [[nodiscard]] virtual Status finish() { return {}; }

  /// Returns the output's own losses since the start, such as frames that its readers missed, under
  /// names that begin with name(). For any thread.
  [[nodiscard]] virtual std::vector<status::NamedCount> losses() const { return {}; }
};

}  // namespace terracut::publish
