// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <chrono>

#include "background_thread.hpp"
#include "firmware_io/live/wake_event.hpp"
#include "firmware_io/sinks/turn_stream_server.hpp"
#include "frame_slots.hpp"

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

  /// As of the last turn or second. From any thread.
  [[nodiscard]] std::uint64_t missed() const noexcept { return missed_; }
  [[nodiscard]] std::uint64_t cut_short() const noexcept { return cut_short_; }

 private:
  void work();
  [[nodiscard]] bool serve(const Slots::Frame& frame);

  firmware_io::TurnStreamServer server_;
  firmware_io::StreamedSensor sensor_;
  std::int64_t deadline_ns_;
  Slots& slots_;
  const firmware_io::WakeEvent& ready_;
  std::atomic<bool> finish_{false};
  std::atomic<std::uint64_t> missed_{0}, cut_short_{0};
  BackgroundThread thread_;  ///< Last: it uses all of the above.
};

}  // namespace terracut::cli
