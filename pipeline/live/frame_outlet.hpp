// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>

#include "frame_pool.hpp"
#include "pipeline/publish/publisher.hpp"
#include "pipeline/publish/reopened.hpp"
#include "pipeline/stream/frame_stream_server.hpp"
#include "rt/queues/latest_value.hpp"
#include "rt/threads/background_thread.hpp"
#include "rt/threads/wake_event.hpp"

namespace terracut::live {

/// Takes labelled points from the segmenting thread and hands them out, on a thread of its own
/// that waits for nobody: to the readers of the stream, and to every other output by its queue. The
/// stream has no queue: its server makes no call that waits, and a reader that is busy misses the
/// frame, so it is served right here. While its address is not to be had, it is tried again.
class FrameOutlet {
 public:
  using Slots = FramePool<points::LabelledPoint>;
  struct Stream {
    publish::Reopened<stream::FrameStreamServer> server;
    sensor::SensorModel sensor;
    std::int64_t deadline_ns;
  };

  /// `ready` is woken when there is something in `slots`, and at finish(). All must outlive this.
  FrameOutlet(std::optional<Stream> stream, publish::Publisher& publisher, Slots& slots,
              const threads::WakeEvent& ready);
  ~FrameOutlet() { begin_to_finish(); }

  /// After LiveThreads::stop(). False when it does not end in time, which no peer can bring about.
  [[nodiscard]] bool finish(std::chrono::milliseconds patience);

  [[nodiscard]] bool has_stream() const noexcept { return stream_.has_value(); }
  /// Frames that came while the stream's address was not to be had. From any thread.
  [[nodiscard]] std::uint64_t frames_while_closed() const noexcept { return while_closed_; }
  /// Of the stream, as of the last frame or second. From one other thread.
  [[nodiscard]] const stream::FrameStreamFigures& figures() const noexcept {
    (void)figures_.take_if_new();
    return figures_.newest_taken();
  }

 private:
  void begin_to_finish();
  void work();
  /// Whether it got where it was to go, or is counted there.
  [[nodiscard]] bool hand_out(const Slots::Frame& frame);
  [[nodiscard]] bool stream(const Slots::Frame& frame);
  /// The stream, where there is one and its address is to be had.
  [[nodiscard]] stream::FrameStreamServer* server() {
    return stream_ ? stream_->server.get() : nullptr;
  }

  std::optional<Stream> stream_;
  publish::Publisher& publisher_;
  Slots& slots_;
  const threads::WakeEvent& ready_;
  std::atomic<bool> finish_{false};
  std::atomic<std::uint64_t> while_closed_{0};
  mutable queues::LatestValue<stream::FrameStreamFigures> figures_;
  threads::BackgroundThread thread_;  ///< Last: it uses all of the above.
};

}  // namespace terracut::live
