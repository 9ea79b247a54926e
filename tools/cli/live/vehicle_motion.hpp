// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "firmware_io/can/motion_signals.hpp"
#include "firmware_io/can/socketcan_source.hpp"
#include "firmware_io/motion/ego_motion.hpp"
#include "live_thread_state.hpp"
#include "rt/bus_figures.hpp"
#include "rt/fixed_memory.hpp"
#include "rt/grant.hpp"
#include "rt/latest_value.hpp"
#include "rt/nonblocking.hpp"

namespace terracut::cli {

/// Hears the vehicle's CAN bus on a thread of its own and makes motion of it for the decoder:
///
///   bus --SocketCanSource--> MotionSignals --EgoMotion (lock-free)--> the decoder, on its thread
///                                 |
///                                 '-- LatestValue --> whoever calls show()
///
/// The bus cannot hold up a frame: the decoder takes what motion there is and never waits for any,
/// and after every batch (64 frames) the thread rests for a millisecond, so that a flood costs no
/// more than reading three times what a bus of 1 Mbit/s can carry; what is beyond it the kernel
/// drops, and counts. Frames bear the kernel's stamps, so resting makes nothing less exact. A flood
/// of the motion itself is thinned to a sample every two milliseconds, so that it does not push
/// the motion of the turn's end out of the decoder's queue.
///
/// The thread allocates, locks and writes nothing.
class VehicleMotion {
 public:
  /// `signals` are those that `source` was opened for. Takes the memory of the motion from
  /// `memory`; `source` and that must outlive this. Errors as EgoMotion.
  VehicleMotion(firmware_io::MotionSignals signals, const firmware_io::EgoMotion::Config& config,
                firmware_io::SocketCanSource& source, rt::FixedMemory& memory);
  ~VehicleMotion();
  VehicleMotion(const VehicleMotion&) = delete;
  VehicleMotion& operator=(const VehicleMotion&) = delete;

  /// Answers what the system granted and refused the thread. `priority`: SCHED_FIFO, 0: shared.
  [[nodiscard]] std::vector<rt::Grant> start(int priority);
  void stop();

  /// For one other thread, which reads it.
  [[nodiscard]] firmware_io::EgoMotion& motion() noexcept { return motion_; }

  /// Fills in what is known of the bus and the samples, not what comes from frames. From one
  /// thread.
  void show(rt::MotionFigures& figures) noexcept;
  [[nodiscard]] const LiveThreadState& thread_state() const noexcept { return thread_state_; }

 private:
  /// As of the thread's last look.
  struct Heard {
    firmware_io::CanReceiveCounters bus;
    firmware_io::MotionCounters signals;
    rt::MotionState state = rt::MotionState::kWaiting;
    std::uint64_t spare_samples = 0;
    std::int64_t last_sample_ns = 0;  ///< Of those that were not spare.
  };

  void hear() noexcept TERRACUT_NONBLOCKING;
  void take(const firmware_io::CanFrame& frame, Heard& heard) noexcept TERRACUT_NONBLOCKING;
  void publish(Heard heard) noexcept TERRACUT_NONBLOCKING;

  firmware_io::MotionSignals signals_;
  firmware_io::EgoMotion motion_;
  firmware_io::SocketCanSource& source_;

  rt::LatestValue<Heard> heard_;
  LiveThreadState thread_state_;
  std::atomic<bool> stop_{false};
  std::jthread thread_;
};

}  // namespace terracut::cli
