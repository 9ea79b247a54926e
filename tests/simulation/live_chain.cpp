// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tests/simulation/live_chain.hpp"

#include "firmware_io/net/packet_ring.hpp"
#include "pipeline/stage/stage.hpp"

namespace terracut::simulation {
namespace {

constexpr double kRecorder_s = 2;
constexpr std::int64_t kLongestGathering_ns = 2'000'000;

net::PacketRingSize recorder_size(const SensorLoop& loop) {
  return net::packet_ring_size(kRecorder_s, 1e9 / static_cast<double>(loop.period_ns),
                               SensorLoop::kMostPacketBytes);
}

}  // namespace

decode::Decoder::Config decoder_config(const SensorLoop& loop, vehicle::EgoMotion* motion) {
  decode::Decoder::Config config;
  config.columns = loop.columns;
  config.reorder_packets = 0;
  config.motion = motion;
  return config;
}

LiveChain::LiveChain(const SensorLoop& loop, const ground::TurnMethodMaker& method,
                     Machine& machine, Network& network)
    : turns(loop.calibration, loop.profile, decoder_config(loop, &motion), method, memory),
      recorder(recorder_size(loop), memory),
      labels("label slots", 8, turns.decoder().return_capacity(), memory),
      points("point slots", 2, turns.decoder().return_capacity(), memory,
             live::FramePool<points::LabelledPoint>::Heights::kKept),
      reader(turns.decoder().make_reader(memory)),
      sectors("sector slots",
              turns.decoder().return_capacity() / (reader->rows().size() * frame::kTileFirings),
              reader->rows().size() * frame::kTileFirings, memory),
      monitor({.deadline_ns = kDeadline_ns, .stage_names = stage::kStageNames}, memory),
      machine_of_thread(machine) {
  labeller.emplace(Labeller::Config{.deadline_ns = kDeadline_ns,
                                    .frame_period_ns = loop.turn_ns(),
                                    .gathering = {.frame_period_ns = loop.turn_ns(),
                                                  .longest_ns = kLongestGathering_ns,
                                                  .room_packets = network.room_packets()}},
                   turns, network,
                   Labeller::Outlets{.records = &records,
                                     .intake = &intake,
                                     .labels = &labels,
                                     .points = &points,
                                     .sectors = &sectors,
                                     .points_ready = &points_ready,
                                     .reader = reader.get(),
                                     .near_ground = &near_ground,
                                     .recorder = &recorder},
                   MachineClock{&machine}, MachineWait{&machine});
}

void LiveChain::work_round() {
  const Labeller::Round round = labeller->work_round(kDeadline_ns / 4);
  if (round.gathering_ns > 0) {
    machine_of_thread.wait_until(machine_of_thread.now_ns() + round.gathering_ns);
  }
}

}  // namespace terracut::simulation
