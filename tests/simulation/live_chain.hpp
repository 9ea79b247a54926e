// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "firmware_io/vehicle/ego_motion.hpp"
#include "pipeline/ground/turn_method.hpp"
#include "pipeline/live/frame_pool.hpp"
#include "pipeline/live/frame_records.hpp"
#include "pipeline/live/latest_near_ground.hpp"
#include "pipeline/live/live_labeller.hpp"
#include "pipeline/live/sector_pool.hpp"
#include "pipeline/recorder/flight_recorder.hpp"
#include "pipeline/run/labelled_turns.hpp"
#include "pipeline/status/deadline_monitor.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "rt/queues/latest_value.hpp"
#include "rt/threads/wake_event.hpp"
#include "tests/simulation/machine.hpp"
#include "tests/simulation/network.hpp"
#include "tests/simulation/sensor_loop.hpp"

namespace terracut::simulation {

/// The parts of a live run, put together as live::LiveParts and live::LiveThread do, on a simulated
/// machine and network.
struct LiveChain {
  static constexpr std::int64_t kDeadline_ns = 50'000'000;
  using Labeller = live::LiveLabeller<Network, MachineClock, MachineWait>;

  LiveChain(const SensorLoop& loop, const ground::TurnMethodMaker& method, Machine& machine,
            Network& network);

  /// The loop of the thread with a deadline: one round of it.
  void work_round();

  memory::FixedMemory memory;
  vehicle::EgoMotion motion{{}, memory};
  run::LabelledTurns turns;
  recorder::FlightRecorder recorder;
  live::FrameRecords records{memory};
  queues::LatestValue<status::InputState> intake;
  live::FramePool<frame::Label> labels;
  live::FramePool<points::LabelledPoint> points;
  std::unique_ptr<frame::TileReader> reader;
  live::SectorPool sectors;
  threads::WakeEvent points_ready = *threads::WakeEvent::make();
  live::LatestNearGround near_ground{memory};
  status::DeadlineMonitor monitor;
  Machine& machine_of_thread;
  std::optional<Labeller> labeller;
};

/// How the decoder of a simulated run is set: as for a live run.
[[nodiscard]] decode::Decoder::Config decoder_config(const SensorLoop& loop,
                                                     vehicle::EgoMotion* motion);

}  // namespace terracut::simulation
