// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "pipeline/publish/frame_buffers.hpp"
#include "pipeline/publish/sink_worker.hpp"

namespace terracut::publish {

/// Hands every labelled frame to every output, each with a queue and a thread of its own: an output
/// that stops holds up no other. One that fails says so once, by name, and the others go on.
///
///   whoever labels  buffer(), fill it, put()  --->  queue  ->  thread  ->  FrameSink
///                                             `-->  queue  ->  thread  ->  FrameSink
///
/// From one thread without a deadline, but for what says otherwise.
class Publisher {
 public:
  using Sinks = std::vector<std::unique_ptr<FrameSink>>;

  Publisher(Sinks sinks, WhenFull when_full, SinkWorker::OnFailure on_failure);

  [[nodiscard]] bool has_sinks() const noexcept { return !workers_.empty(); }

  /// Room for the next frame. With kWait, waits until an output is done with one; else never.
  [[nodiscard]] std::shared_ptr<LabelledFrame> buffer() { return buffers_.take(); }
  /// Nobody may change it any more.
  void put(const SharedFrame& frame);
  /// From one other thread perhaps.
  void put_figures(const status::MonitorSnapshot& figures);

  /// After the last frame: writes what waits. `patience`: how long an output may be at one frame, or
  /// at its end; none: as long as it takes. False when an output does not answer; then the process
  /// must end without destroying this.
  [[nodiscard]] bool finish(std::optional<std::chrono::milliseconds> patience);

  /// The first error of any output. From any thread, as the next.
  [[nodiscard]] Status outcome() const;
  /// By output: frames left out (NAME_frames_left_out), and what it counts itself. `over`: what
  /// waits by now is lost as well.
  [[nodiscard]] std::vector<status::NamedCount> losses(bool over = false) const;

 private:
  [[nodiscard]] static std::size_t buffers_for(const Sinks& sinks) noexcept;

  FrameBuffers buffers_;
  std::vector<std::unique_ptr<SinkWorker>> workers_;
};

}  // namespace terracut::publish
