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

/// Hands every labelled frame to every output. Each output has its own queue and thread, so a
/// stalled output delays no other. A failing output is reported once, by name; the others go on.
///
///   whoever labels  buffer(), fill it, put()  --->  queue  ->  thread  ->  FrameSink
///                                             `-->  queue  ->  thread  ->  FrameSink
///
/// For one thread without a deadline, unless stated otherwise.
class Publisher {
 public:
  using Sinks = std::vector<std::unique_ptr<FrameSink>>;

  Publisher(Sinks sinks, WhenFull when_full, SinkWorker::OnFailure on_failure);

  [[nodiscard]] bool has_sinks() const noexcept { return !workers_.empty(); }
  /// True if some output wants the sectors of each frame.
  [[nodiscard]] bool wants_sectors() const noexcept;

  /// Returns room for the next frame. With kWait, waits until an output has finished with a frame;
  /// otherwise never waits.
  [[nodiscard]] std::shared_ptr<LabelledFrame> buffer() { return buffers_.take(); }
  /// Hands out a frame, which may not be changed any more.
  void put(const SharedFrame& frame);
  /// Hands a sector, which may not be changed any more, to the outputs that want sectors; those of
  /// a frame before the frame. Never waits.
  void put_sector(const SharedSector& sector);
  /// Hands out figures. May be called from one other thread.
  void put_figures(const status::MonitorSnapshot& figures);

  /// Writes all that waits; call it after the last frame. `patience` is the longest time an output
  /// may take for one frame or sector, or to end; without it there is no limit. Returns false if an
  /// output does not answer; the process must then end without destroying this object.
  [[nodiscard]] bool finish(std::optional<std::chrono::milliseconds> patience);

  /// Returns the first error of any output. This and the next function may be called on any thread.
  [[nodiscard]] Status outcome() const;
  /// Returns each output's left-out frames (NAME_frames_left_out), sectors likewise, and the
  /// output's own losses. If `over` is true, those that still wait count as lost.
  [[nodiscard]] std::vector<status::NamedCount> losses(bool over = false) const;

 private:
  [[nodiscard]] static std::size_t buffers_for(const Sinks& sinks) noexcept;

  FrameBuffers buffers_;
  std::vector<std::unique_ptr<SinkWorker>> workers_;
};

}  // namespace terracut::publish
