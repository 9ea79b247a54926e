// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <chrono>

#include "frame_pool.hpp"
#include "pipeline/stream/frame_stream_server.hpp"
#include "rt/queues/latest_value.hpp"
#include "rt/threads/background_thread.hpp"
#include "rt/threads/wake_event.hpp"

namespace terracut::run {

/// Hands labelled points to other processes, on a thread of its own.
class StreamWriter {
 public:
  using Slots = FramePool<stream::LabelledPoint>;

  /// `ready` is woken when there is something in `slots`, and at finish(). All must outlive this.
  StreamWriter(stream::FrameStreamServer server, stream::StreamedSensor sensor,
               std::int64_t deadline_ns, Slots& slots, const threads::WakeEvent& ready);

  /// After LiveThreads::stop(). False when it does not end in time, which no peer can bring about.
  [[nodiscard]] bool finish(std::chrono::milliseconds patience);

  /// As of the last frame or second. From one other thread.
  [[nodiscard]] const stream::FrameStreamFigures& figures() const noexcept {
    (void)figures_.take_if_new();
    return figures_.newest_taken();
  }

 private:
  void work();
  [[nodiscard]] bool serve(const Slots::Frame& frame);

  stream::FrameStreamServer server_;
  stream::StreamedSensor sensor_;
  std::int64_t deadline_ns_;
  Slots& slots_;
  const threads::WakeEvent& ready_;
  std::atomic<bool> finish_{false};
  mutable queues::LatestValue<stream::FrameStreamFigures> figures_;
  threads::BackgroundThread thread_;  ///< Last: it uses all of the above.
};

}  // namespace terracut::run
