// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <chrono>

#include "background_thread.hpp"
#include "firmware_io/live/wake_event.hpp"
#include "firmware_io/sinks/turn_stream_server.hpp"
#include "frame_slots.hpp"
#include "rt/latest_value.hpp"

namespace terracut::cli {

/// Hands labelled points to other processes, on a thread of its own.
class StreamWriter {
 public:
  using Slots = FrameSlots<firmware_io::LabelledPoint>;

  /// `ready` is woken when there is something in `slots`, and at finish(). All must outlive this.
  StreamWriter(firmware_io::TurnStreamServer server, firmware_io::StreamedSensor sensor,
               std::int64_t deadline_ns, Slots& slots, const firmware_io::WakeEvent& ready);

  /// After LiveThreads::stop(). False when it does not end in time, which no peer can bring about.
  [[nodiscard]] bool finish(std::chrono::milliseconds patience);

  /// Turns times readers that did not get them, and readers that got none: TurnStreamFigures.
  struct Losses {
    std::uint64_t missed = 0, cut_short = 0, too_large = 0, refused = 0, stalled = 0;
  };
  /// As of the last turn or second. From one other thread.
  [[nodiscard]] const Losses& losses() const noexcept {
    (void)losses_.take_if_new();
    return losses_.newest_taken();
  }

 private:
  void work();
  [[nodiscard]] bool serve(const Slots::Frame& frame);

  firmware_io::TurnStreamServer server_;
  firmware_io::StreamedSensor sensor_;
  std::int64_t deadline_ns_;
  Slots& slots_;
  const firmware_io::WakeEvent& ready_;
  std::atomic<bool> finish_{false};
  mutable rt::LatestValue<Losses> losses_;
  BackgroundThread thread_;  ///< Last: it uses all of the above.
};

}  // namespace terracut::cli
