// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "firmware_io/can/can_frame.hpp"
#include "firmware_io/can/can_receive_counters.hpp"
#include "firmware_io/net/receive_counters.hpp"
#include "firmware_io/vehicle/ego_motion.hpp"
#include "firmware_io/vehicle/motion_signals.hpp"
#include "pipeline/status/bus_figures.hpp"
#include "rt/queues/latest_value.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::live {

/// State and figures of the vehicle's bus and motion after the latest work_round().
struct HeardMotion {
  can::CanReceiveCounters bus;
  vehicle::MotionCounters signals;
  status::MotionState state = status::MotionState::kWaiting;
  std::uint64_t spare_samples = 0;
  std::int64_t last_sample_ns = 0;  ///< Stamp of the newest sample in use.
};

/// Turns CAN frames into samples of the vehicle's motion. One thread, which calls work_round()
/// repeatedly; allocates, locks and writes nothing. A flood of samples is thinned to one every two
/// milliseconds, so that it does not push the motion at the frame's end out of the decoder's queue.
///
/// `Source` is like can::SocketCanSource, `Clock` like measure::SystemClock.
template <class Source, class Clock>
class MotionReceiver {
 public:
  /// All arguments must outlive this object.
  MotionReceiver(vehicle::MotionSignals& signals, vehicle::EgoMotion& motion, Source& source,
                 queues::LatestValue<HeardMotion>& heard, Clock clock) noexcept
      : signals_(signals), motion_(motion), source_(source), heard_(heard), clock_(clock) {}

  /// Waits at most `timeout_ns` for CAN frames, processes them, and updates what is known. Returns
  /// false if no frame came.
  bool work_round(std::int64_t timeout_ns) noexcept TERRACUT_NONBLOCKING {
    const auto frames = source_.receive(timeout_ns);
    for (const can::CanFrame& frame : frames) take(frame);
    publish();
    return !frames.empty();
  }

 private:
  /// Least time between samples: no car's speed or yaw rate changes noticeably faster.
  static constexpr std::int64_t kClosest_ns = 2'000'000;

  void take(const can::CanFrame& frame) noexcept {
    const auto sample = signals_.take(frame);
    if (!sample) return;
    const std::int64_t since_last_ns = sample->stamp_ns - now_.last_sample_ns;
    if (since_last_ns >= 0 && since_last_ns < kClosest_ns) {
      ++now_.spare_samples;
      return;
    }
    (void)motion_.add(*sample);
    now_.last_sample_ns = sample->stamp_ns;
  }

  void publish() noexcept {
    const bool known = signals_.alive(clock_.realtime_ns());
    now_.bus = source_.counters();
    now_.signals = signals_.counters();
    now_.state = state(known);
    heard_.publish(now_);
  }

  [[nodiscard]] status::MotionState state(bool known) const noexcept {
    using status::MotionState;
    if (source_.link() == net::LinkState::kGone) return MotionState::kInterfaceGone;
    if (source_.link() == net::LinkState::kDown) return MotionState::kInterfaceDown;
    if (source_.bus_off()) return MotionState::kBusOff;
    if (known) return MotionState::kKnown;
    return now_.last_sample_ns != 0 ? MotionState::kLost : MotionState::kWaiting;
  }

  vehicle::MotionSignals& signals_;
  vehicle::EgoMotion& motion_;
  Source& source_;
  queues::LatestValue<HeardMotion>& heard_;
  Clock clock_;
  HeardMotion now_;
};

}  // namespace terracut::live
