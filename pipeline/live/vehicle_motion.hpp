// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "firmware_io/can/socketcan_source.hpp"
#include "firmware_io/vehicle/ego_motion.hpp"
#include "firmware_io/vehicle/motion_signals.hpp"
#include "pipeline/live/live_thread_state.hpp"
#include "pipeline/live/motion_receiver.hpp"
#include "pipeline/status/bus_figures.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/queues/latest_value.hpp"
#include "rt/threads/grant.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::live {

/// Hears the vehicle's CAN bus on a thread of its own and makes motion of it for the decoder:
///
///   bus --SocketCanSource--> MotionReceiver --EgoMotion (lock-free)--> the decoder, on its thread
///                                 |
///                                 '-- LatestValue --> whoever calls show()
///
/// The bus cannot hold up a frame: the decoder takes what motion there is and never waits for any,
/// and after every batch (64 frames) the thread rests for a millisecond, so that a flood costs no
/// more than reading three times what a bus of 1 Mbit/s can carry; what is beyond it the kernel
/// drops, and counts. Frames bear the kernel's stamps, so resting makes nothing less exact.
///
/// The thread allocates, locks and writes nothing.
class VehicleMotion {
 public:
  /// `signals` are those that `source` was opened for. Takes the memory of the motion from
  /// `memory`; `source` and that must outlive this. Errors as EgoMotion.
  VehicleMotion(vehicle::MotionSignals signals, const vehicle::EgoMotion::Config& config,
                can::SocketCanSource& source, memory::FixedMemory& memory);
  ~VehicleMotion();
  VehicleMotion(const VehicleMotion&) = delete;
  VehicleMotion& operator=(const VehicleMotion&) = delete;

  /// Returns what the system granted and refused the thread. `priority`: SCHED_FIFO, 0: shared.
  [[nodiscard]] std::vector<threads::Grant> start(int priority);
  void stop();

  /// For one other thread, which reads it.
  [[nodiscard]] vehicle::EgoMotion& motion() noexcept { return motion_; }

  /// Fills in what is known of the bus and the samples, not what comes from frames. From one
  /// thread.
  void show(status::MotionFigures& figures) noexcept;
  [[nodiscard]] const LiveThreadState& thread_state() const noexcept { return thread_state_; }

 private:
  void hear() noexcept TERRACUT_NONBLOCKING;

  vehicle::MotionSignals signals_;
  vehicle::EgoMotion motion_;
  can::SocketCanSource& source_;

  queues::LatestValue<HeardMotion> heard_;
  LiveThreadState thread_state_;
  std::atomic<bool> stop_{false};
  std::jthread thread_;
};

}  // namespace terracut::live
