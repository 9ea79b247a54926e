// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "terracut/live_run.hpp"

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "calib/terracut/calibration_table.hpp"
#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/net/live_source.hpp"
#include "firmware_io/streams/first_seconds.hpp"
#include "firmware_io/terracut/points.hpp"
#include "firmware_io/terracut/public_sensor.hpp"
#include "pipeline/ground/profile.hpp"
#include "pipeline/live/live_pipeline.hpp"
#include "pipeline/live/live_threads.hpp"
#include "pipeline/live/mount_on_air.hpp"
#include "pipeline/output/label_sink.hpp"
#include "rt/memory/locked_memory.hpp"

namespace terracut {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// What was packed for a stream as a class of SemanticKITTI.
Label label_of(std::uint8_t semantic_kitti_class) noexcept {
  for (const Label label : {Label::kGround, Label::kObstacle, Label::kOtherGround}) {
    if (output::semantic_kitti_class(label) == semantic_kitti_class) return label;
  }
  return Label::kNone;
}

Expected<streams::SensorOnAir> listen(net::LiveSource& source, const LiveRun::Config& config,
                                      const LiveRun::StopWanted& stop_wanted) {
  streams::FirstSeconds::Config of_first;
  of_first.place = source.name();
  if (config.calibration) {
    of_first.model = model_of(config.calibration->sensor());
    of_first.calibration.unit = config.calibration->table().unit;
  }
  streams::FirstSeconds first(std::move(of_first));
  const auto begun = SteadyClock::now();
  const auto is_over = [&] {
    return config.patience_s &&
           SteadyClock::now() - begun >= std::chrono::duration<double>(*config.patience_s);
  };
  while (!first.is_enough() && !is_over() && !stop_wanted()) {
    constexpr std::int64_t kAWhile_ns = 50'000'000;
    for (const packet::Datagram& datagram : source.receive(kAWhile_ns)) first.add(datagram);
  }
  return first.conclude(config.patience_s);
}

}  // namespace

struct LiveRun::Engine {
  Engine(const Config& config, net::LiveSource&& opened, streams::SensorOnAir&& heard,
         std::optional<FoundMount> mount, live::LiveThreads::Events&& events)
      : source(std::move(opened)),
        sensor(std::move(heard)),
        found_mount(mount),
        deadline_ns(static_cast<std::int64_t>(config.deadline_ms * 1e6)),
        pipeline(
            sensor.calibration,
            calib::ring_profile(sensor.calibration, mount_of(mount ? mount->mount : config.mount)),
            decoder_config(sensor), ground::terracut_profile(), memory),
        threads(threads_config(config, sensor), pipeline, source, std::move(events), nullptr,
                memory),
        points(pipeline.decoder.return_capacity()),
        labels(points.size()),
        times_s(points.size()) {}

  static decode::Decoder::Config decoder_config(const streams::SensorOnAir& sensor) {
    decode::Decoder::Config config;
    config.columns = sensor.columns;
    config.reorder_packets = 0;  // one cable delivers in order
    return config;
  }
  static live::LiveThreads::Config threads_config(const Config& config,
                                                  const streams::SensorOnAir& sensor) {
    live::LiveThreads::Config of_threads;
    of_threads.deadline_ns = static_cast<std::int64_t>(config.deadline_ms * 1e6);
    if (sensor.spin_hz > 0) {
      of_threads.frame_period_ns = static_cast<std::int64_t>(1e9 / sensor.spin_hz);
    }
    of_threads.longest_gathering_ns = static_cast<std::int64_t>(config.gather_ms * 1e6);
    of_threads.keeps_points = true;
    of_threads.receive = live::thread_request("tc-receive", config.receive_priority, std::nullopt);
    of_threads.segment = live::thread_request("tc-segment", config.segment_priority, std::nullopt);
    return of_threads;
  }

  void note(const std::vector<threads::Grant>& grants) {
    for (const threads::Grant& grant : grants) {
      if (!grant.granted) refusals += threads::to_line(grant) + "\n";
    }
  }
  void hand_out(const OnFrame& on_frame) {
    auto& slots = *threads.points();
    for (live::FramePool<stream::LabelledPoint>::Frame taken; slots.take(taken);) {
      for (std::size_t i = 0; i < taken.items.size(); ++i) {
        const stream::LabelledPoint& point = taken.items[i];
        points[i] = {point.x_m, point.y_m, point.z_m, point.row, point.intensity};
        labels[i] = label_of(point.label);
        times_s[i] = point.time_s;
      }
      Frame frame{.number = taken.record.info.number,
                  .first_packet_ns = taken.record.info.first_packet_ns,
                  .last_packet_ns = taken.record.info.last_packet_ns,
                  .complete = taken.record.info.complete,
                  .deskewed = taken.record.info.deskew.state == frame::DeskewState::kDone,
                  .packets_lost = taken.record.info.losses.network_gap_packets,
                  .points = std::span<const Point>(points).first(taken.items.size()),
                  .labels = std::span<const Label>(labels).first(taken.items.size()),
                  .time_s = std::span<const float>(times_s).first(taken.items.size())};
      on_frame(frame);
      slots.give_back(true);
      ++figures.frames;
    }
  }
  void judge() {
    for (status::FrameRecord frame; threads.take_record(frame);) {
      const bool is_skipped = frame.level == status::Level::kSkipped;
      figures.frames_skipped += is_skipped ? 1 : 0;
      figures.deadlines_missed +=
          is_skipped || frame.labels_ns - frame.info.last_packet_ns > deadline_ns ? 1 : 0;
    }
  }

  std::unique_ptr<memory::FixedMemory> source_memory;  ///< Of the socket's buffers.
  memory::FixedMemory memory;
  net::LiveSource source;
  streams::SensorOnAir sensor;
  std::optional<FoundMount> found_mount;
  std::int64_t deadline_ns;
  live::LivePipeline pipeline;
  live::LiveThreads threads;
  std::vector<Point> points;
  std::vector<Label> labels;
  std::vector<float> times_s;
  std::string refusals;
  Figures figures;
};

LiveRun::LiveRun(std::unique_ptr<Engine> engine) noexcept : engine_(std::move(engine)) {}
LiveRun::LiveRun(LiveRun&&) noexcept = default;
LiveRun& LiveRun::operator=(LiveRun&&) noexcept = default;
LiveRun::~LiveRun() = default;

Expected<LiveRun> LiveRun::open(const Config& config, const StopWanted& stop_wanted) {
  const auto address = net::parse_ipv4_address(config.address);
  if (!address) return tl::unexpected(address.error());
  if (!(config.deadline_ms >= 1 && config.deadline_ms <= 10'000)) {
    return fail(ErrorCode::kInvalidArgument, "deadline_ms must be 1 to 10000");
  }
  net::ListenConfig listen_config;
  listen_config.at = {*address, config.port};
  auto source_memory = std::make_unique<memory::FixedMemory>();
  auto source = net::LiveSource::open(listen_config, *source_memory);
  if (!source) return tl::unexpected(source.error());
  auto sensor = listen(*source, config, stop_wanted);
  if (!sensor) return tl::unexpected(sensor.error());
  source->accept_only(sensor->sender);
  std::optional<FoundMount> mount;
  if (config.find_mount) {
    const auto found = live::mount_on_air(*source, *sensor, Engine::decoder_config(*sensor),
                                          live::kGroundPatience, stop_wanted)
                           .certain();
    if (found) mount = public_mount(*found);
    if (!found && !config.guess_mount) return tl::unexpected(mount_not_found(found.error()));
  }
  auto events = live::LiveThreads::Events::make();
  if (!events) return tl::unexpected(events.error());
  std::vector<threads::Grant> grants;
  if (config.lock_memory) grants = memory::hold_memory({});
  return made([&] {
    auto engine = std::make_unique<Engine>(config, *std::move(source), *std::move(sensor), mount,
                                           *std::move(events));
    engine->source_memory = std::move(source_memory);
    engine->note(grants);
    return LiveRun(std::move(engine));
  });
}

Sensor LiveRun::sensor() const noexcept {
  return public_sensor(engine_->sensor.model);
}

const std::optional<FoundMount>& LiveRun::found_mount() const noexcept {
  return engine_->found_mount;
}

const std::string& LiveRun::refusals() const noexcept {
  return engine_->refusals;
}

void LiveRun::run(const StopWanted& stop_wanted, const OnFrame& on_frame) {
  Engine& of = *engine_;
  of.note(of.threads.start());
  constexpr std::int64_t kAWhile_ns = 50'000'000;
  while (!stop_wanted()) {
    (void)of.threads.points_ready().wait(-1, kAWhile_ns);
    of.hand_out(on_frame);
    of.judge();
  }
  of.threads.stop();
  of.hand_out(on_frame);
  of.judge();
}

LiveRun::Figures LiveRun::figures() const noexcept {
  Figures figures = engine_->figures;
  const status::InputState& intake = engine_->threads.intake();
  figures.datagrams = intake.account.source.received;
  figures.decoded = intake.account.decoded;
  figures.frames_left_out = engine_->threads.points()->unused();
  return figures;
}

}  // namespace terracut
