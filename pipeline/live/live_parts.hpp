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
#include "pipeline/live/live_thread.hpp"
#include "pipeline/live/vehicle_motion.hpp"
#include "pipeline/recorder/flight_recorder.hpp"
#include "pipeline/status/deadline_monitor.hpp"
#include "rt/error.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/threads/grant.hpp"
#include "rt/threads/wake_event.hpp"

namespace terracut::live {

/// The settings for the vehicle's motion. `source` is a CAN bus opened for the messages of
/// `signals`.
struct VehicleConfig {
  const vehicle::MotionSignals* signals = nullptr;
  can::SocketCanSource* source = nullptr;
  vehicle::EgoMotion::Config motion;
  int priority = 60;  ///< SCHED_FIFO priority of the thread; 0: shared scheduling.
};

/// The configuration of a live run; the defaults are those of `terracut live` and LiveRun.
struct LiveConfig {
  decode::Decoder::Config decoder;  ///< LiveParts sets `reorder_packets`, `motion` and `buffers`.
  int reorder_packets = 0;          ///< 0, because one cable keeps packets in order.
  ground::SegmenterConfig method = ground::terracut_profile();
  LiveThread::Config thread;    ///< LiveParts sets `frame_period_ns` and `keeps_heights`.
  double recorder_seconds = 0;  ///< How long packets are kept for dumps; 0: not kept.
  std::optional<VehicleConfig> vehicle;
};

/// The computing parts of a live run in fixed memory, put together in the same way for the program
/// and the library. All arguments must outlive this object.
struct LiveParts {
  static constexpr std::size_t kKeptFrames = 256;  ///< Kept by `monitor` for traces and dumps.

  std::optional<VehicleMotion> motion;  ///< Exists if LiveConfig::vehicle is set.
  run::LabelledTurns turns;
  std::optional<recorder::FlightRecorder> recorder;
  LiveThread thread;
  status::DeadlineMonitor monitor;  ///< Used by the thread that takes records.

  LiveParts(const LiveConfig& config, const streams::SensorOnAir& sensor,
            const mount::RingProfile& profile, net::LiveSource& source,
            threads::WakeEvent points_ready, memory::FixedMemory& memory);
  /// Builds the parts in one region of `memory`, locked on request. `grants` receives what the
  /// system granted. Fails with kCapacityExceeded if no descriptor or memory is left.
  [[nodiscard]] static Expected<std::unique_ptr<LiveParts>> build(
      const LiveConfig& config, const streams::SensorOnAir& sensor,
      const mount::RingProfile& profile, net::LiveSource& source, memory::FixedMemory& memory,
      bool locks_memory, std::vector<threads::Grant>& grants);

  /// Starts all threads. Returns what the system granted to the threads and what it refused.
  [[nodiscard]] std::vector<threads::Grant> start();
  void stop();

 private:
  int motion_priority_;
};

}  // namespace terracut::live
