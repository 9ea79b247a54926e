// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/can/socketcan_source.hpp"
#include "firmware_io/net/live_source.hpp"
#include "firmware_io/streams/first_seconds.hpp"
#include "firmware_io/vehicle/ego_motion.hpp"
#include "firmware_io/vehicle/motion_signals.hpp"
#include "pipeline/ground/profile.hpp"
#include "pipeline/live/live_pipeline.hpp"
#include "pipeline/live/live_threads.hpp"
#include "pipeline/live/vehicle_motion.hpp"
#include "pipeline/recorder/flight_recorder.hpp"
#include "pipeline/status/deadline_monitor.hpp"
#include "rt/error.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/grant.hpp"

namespace terracut::live {

/// The vehicle's motion, heard on its CAN bus. `source` was opened for `signals`.
struct VehicleConfig {
  const vehicle::MotionSignals* signals = nullptr;
  can::SocketCanSource* source = nullptr;
  vehicle::EgoMotion::Config motion;
  int priority = 60;  ///< SCHED_FIFO; 0: shared.
};

/// How a live run works; the defaults are those of `terracut live` and of terracut::LiveRun.
struct LiveConfig {
  decode::Decoder::Config decoder;  ///< LiveParts sets `reorder_packets`, `motion` and `images`.
  int reorder_packets = 0;          ///< One cable delivers in order.
  ground::SegmenterConfig method = ground::terracut_profile();
  LiveThreads::Config threads;  ///< LiveParts sets `frame_period_ns`.
  double recorder_seconds = 0;  ///< Packets of this time are kept; 0: none.
  std::optional<VehicleConfig> vehicle;
};

/// All that a live run computes with, in fixed memory: the one composition for the program and for
/// the library. Everything given must outlive it.
struct LiveParts {
  static constexpr std::size_t kKeptFrames = 256;  ///< By `monitor`, for traces and dumps.

  std::optional<VehicleMotion> motion;  ///< With LiveConfig::vehicle.
  LivePipeline pipeline;
  std::optional<recorder::FlightRecorder> recorder;
  LiveThreads threads;
  status::DeadlineMonitor monitor;  ///< Of whoever takes the threads' records.

  LiveParts(const LiveConfig& config, const streams::SensorOnAir& sensor,
            const mount::RingProfile& profile, net::LiveSource& source, LiveThreads::Events events,
            memory::FixedMemory& memory);
  /// Builds it in one region of `memory`, which is locked on request. `grants` gets what the system
  /// granted. kCapacityExceeded when the process has no descriptor left, or the system no memory.
  [[nodiscard]] static Expected<std::unique_ptr<LiveParts>> build(
      const LiveConfig& config, const streams::SensorOnAir& sensor,
      const mount::RingProfile& profile, net::LiveSource& source, memory::FixedMemory& memory,
      bool locks_memory, std::vector<threads::Grant>& grants);

  /// Starts every thread; returns what the system granted and refused them.
  [[nodiscard]] std::vector<threads::Grant> start();
  void stop();

 private:
  int motion_priority_;
};

}  // namespace terracut::live
