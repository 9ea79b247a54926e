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

/// An output of labelled frames. All but name(), queue_frames() and losses() is called on one
/// thread of its own without a deadline (Publisher), which it may hold up for as long as it likes.
class FrameSink {
 public:
  FrameSink() = default;
  FrameSink(const FrameSink&) = delete;
  FrameSink& operator=(const FrameSink&) = delete;
  virtual ~FrameSink() = default;

  /// Stable lower_snake_case, as in figures: "mcap".
  [[nodiscard]] virtual std::string_view name() const noexcept = 0;
  /// How many frames may wait for it, >= 1. More help where it stops now and then, as disks do.
  [[nodiscard]] virtual std::size_t queue_frames() const noexcept { return 2; }

  /// `frame` is valid until it returns. After an error it gets nothing more, not even finish().
  [[nodiscard]] virtual Status put(const LabelledFrame& frame) = 0;
  /// The run's figures, about once a second. Errors as of put().
  [[nodiscard]] virtual Status put_figures(const status::MonitorSnapshot& /*figures*/) {
    return {};
  }
  /// After the last frame.
  [[nodiscard]] virtual Status finish() { return {}; }

  /// What it lost since the start by causes of its own, frames for its readers for example, under
  /// names that begin with name(). From any thread.
  [[nodiscard]] virtual std::vector<status::NamedCount> losses() const { return {}; }
};

}  // namespace terracut::publish
