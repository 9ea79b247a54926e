// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/live/live_parts.hpp"

#include <algorithm>
#include <utility>

#include "pipeline/ground/stream_segmenter.hpp"

namespace terracut::live {
namespace {

std::optional<VehicleMotion> motion_of(const LiveConfig& config, memory::FixedMemory& memory) {
  if (!config.vehicle) return std::nullopt;
  const VehicleConfig& vehicle = *config.vehicle;
  return std::make_optional<VehicleMotion>(*vehicle.signals, vehicle.motion, *vehicle.source,
                                           memory);
}

decode::Decoder::Config decoder_config(const LiveConfig& config,
                                       std::optional<VehicleMotion>& motion) {
  decode::Decoder::Config of_decoder = config.decoder;
  of_decoder.reorder_packets = config.reorder_packets;
  of_decoder.motion = motion ? &motion->motion() : nullptr;
  return of_decoder;
}

std::optional<recorder::FlightRecorder> recorder_of(const LiveConfig& config,
                                                    sensor::SensorModel model,
                                                    memory::FixedMemory& memory) {
  if (config.recorder_seconds <= 0) return std::nullopt;
  const sensor::SensorRow& row = sensor::row_of(model);
  return std::make_optional<recorder::FlightRecorder>(
      net::packet_ring_size(config.recorder_seconds, row.most_packets_per_second,
                            row.longest_packet_bytes),
      memory);
}

LiveThread::Config thread_config(const LiveConfig& config, const streams::SensorOnAir& sensor) {
  constexpr double kSlowest_hz = 5;  // assumed if the sensor has not reported its spin rate
  LiveThread::Config of_thread = config.thread;
  of_thread.keeps_heights = config.method.gives_heights;
  of_thread.frame_period_ns =
      static_cast<std::int64_t>(1e9 / std::max(sensor.spin_hz, kSlowest_hz));
  return of_thread;
}

}  // namespace

LiveParts::LiveParts(const LiveConfig& config, const streams::SensorOnAir& sensor,
                     const mount::RingProfile& profile, net::LiveSource& source,
                     threads::WakeEvent points_ready, memory::FixedMemory& memory)
    : motion(motion_of(config, memory)),
      turns(sensor.calibration, profile, decoder_config(config, motion),
            ground::turn_maker_of(config.method, ground::Pace::kLatency), memory),
      recorder(recorder_of(config, sensor.model, memory)),
      thread(thread_config(config, sensor), turns, source, std::move(points_ready),
             recorder ? &*recorder : nullptr, memory),
      monitor({.deadline_ns = config.thread.deadline_ns,
               .stage_names = stage::kStageNames,
               .kept_frames = kKeptFrames},
              memory),
      motion_priority_(config.vehicle ? config.vehicle->priority : 0) {}

Expected<std::unique_ptr<LiveParts>> LiveParts::build(
    const LiveConfig& config, const streams::SensorOnAir& sensor, const mount::RingProfile& profile,
    net::LiveSource& source, memory::FixedMemory& memory, bool locks_memory,
    std::vector<threads::Grant>& grants) {
  const auto build_in = [&](memory::FixedMemory& in) -> Expected<std::unique_ptr<LiveParts>> {
    auto points_ready = threads::WakeEvent::make();
    if (!points_ready) return tl::unexpected(points_ready.error());
    return std::make_unique<LiveParts>(config, sensor, profile, source, *std::move(points_ready),
                                       in);
  };
  memory::FixedMemory plan;
  if (auto trial = build_in(plan); !trial) return trial;
  const auto region = memory.reserve(plan.total_bytes(), {.lock = locks_memory});
  if (!region) return tl::unexpected(region.error());
  grants.insert(grants.end(), region->begin(), region->end());
  auto parts = build_in(memory);
  if (const Status fits = memory.within_plan(); !fits) return tl::unexpected(fits.error());
  return parts;
}

std::vector<threads::Grant> LiveParts::start() {
  std::vector<threads::Grant> grants;
  if (motion) grants = motion->start(motion_priority_);
  for (threads::Grant& grant : thread.start()) grants.push_back(std::move(grant));
  return grants;
}

void LiveParts::stop() {
  thread.stop();
  if (motion) motion->stop();
}

}  // namespace terracut::live
