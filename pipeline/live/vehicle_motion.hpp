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

/// Listens to the vehicle's CAN bus on a thread of its own and gives the decoder the vehicle's
/// motion:
///
///   bus --SocketCanSource--> MotionReceiver --EgoMotion (lock-free)--> the decoder, on its thread
///                                 |
///                                 '-- LatestValue --> whoever calls show()
///
/// The bus cannot delay a frame: the decoder uses the motion known so far and never waits. After
/// every batch (64 CAN frames) the thread pauses for a millisecond, so that a flood costs at most
/// three times the load of a 1 Mbit/s bus; the kernel drops and counts further frames. CAN frames
/// carry the kernel's stamps, so the pauses lose no precision.
///
/// The thread allocates, locks and writes nothing.
class VehicleMotion {
 public:
  /// `signals` are those for which `source` was opened. Takes memory from `memory`; `source` and
  /// `memory` must outlive this object. Throws the errors of EgoMotion's constructor.
  VehicleMotion(vehicle::MotionSignals signals, const vehicle::EgoMotion::Config& config,
                can::SocketCanSource& source, memory::FixedMemory& memory);
  ~VehicleMotion();
  VehicleMotion(const VehicleMotion&) = delete;
  VehicleMotion& operator=(const VehicleMotion&) = delete;

  /// Starts the thread. Returns what the system granted and refused. `priority` is for SCHED_FIFO;
  /// 0 means shared scheduling.
  [[nodiscard]] std::vector<threads::Grant> start(int priority);
  void stop();

  /// Returns the vehicle's motion, to be read by one other thread.
  [[nodiscard]] vehicle::EgoMotion& motion() noexcept { return motion_; }

  /// Fills in the figures of bus and samples, but not those of frames. For one thread.
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
