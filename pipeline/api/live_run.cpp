// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "terracut/live_run.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "calib/api/calibration_table.hpp"
#include "firmware_io/api/points.hpp"
#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/net/live_source.hpp"
#include "firmware_io/streams/hear_sensor.hpp"
#include "pipeline/api/wanted.hpp"
#include "pipeline/live/live_parts.hpp"
#include "pipeline/points/complete_objects.hpp"
#include "pipeline/points/scene_of_points.hpp"
#include "pipeline/run/mount_on_air.hpp"
#include "rt/memory/locked_memory.hpp"

namespace terracut {
namespace {

Expected<streams::SensorOnAir> listen(net::LiveSource& source, const LiveRun::Config& config,
                                      const LiveRun::StopWanted& stop_wanted) {
  streams::FirstSeconds::Config of_first;
  of_first.place = source.name();
  if (config.calibration) {
    of_first.model = calib::model_of(config.calibration->table().unit);
    of_first.calibration.unit = config.calibration->table().unit;
  }
  streams::FirstSeconds first(std::move(of_first));
  return streams::hear_sensor(first, source, nullptr, {config.patience_s, stop_wanted, {}});
}

live::LiveConfig live_config_of(const LiveRun::Config& config, int columns) {
  live::LiveConfig of_run;
  of_run.decoder.columns = columns;
  of_run.method.gives_heights = wants_heights(config);
  of_run.thread.deadline_ns = static_cast<std::int64_t>(config.deadline_ms * 1e6);
  of_run.thread.longest_gathering_ns = static_cast<std::int64_t>(config.gather_ms * 1e6);
  of_run.thread.keeps_points = true;
  of_run.thread.keeps_sectors = config.on_sector != nullptr;
  of_run.thread.thread = live::thread_request("tc-label", config.priority, std::nullopt);
  return of_run;
}

}  // namespace

struct LiveRun::Engine {
  Engine(std::unique_ptr<memory::FixedMemory> memory_of_source, net::LiveSource&& opened,
         streams::SensorOnAir&& heard, std::optional<FoundMount> mount, const Config& config)
      : source_memory(std::move(memory_of_source)),
        source(std::move(opened)),
        sensor(std::move(heard)),
        found_mount(mount),
        wanted(wanted_of(config)),
        on_sector(config.on_sector) {}

  Status build(const live::LiveConfig& config, const Mount& mount, bool locks_memory,
               std::vector<threads::Grant>& grants) {
    const auto profile = calib::ring_profile(sensor.calibration, mount_of(mount));
    auto built =
        live::LiveParts::build(config, sensor, profile, source, memory, locks_memory, grants);
    if (!built) return tl::unexpected(built.error());
    parts = *std::move(built);
    points.resize(parts->turns.decoder().return_capacity());
    labels.resize(points.size());
    times_s.resize(points.size());
    if (wanted.any()) {
      scene = std::make_unique<points::SceneOfPoints>(wanted, profile,
                                                      parts->turns.decoder().shape(), points.size(),
                                                      parts->turns.decoder().beam_turns());
    }
    if (wanted.objects && on_sector) {
      complete = std::make_unique<points::CompleteObjects>(profile, parts->turns.decoder().shape(),
                                                           points.size());
    }
    return {};
  }

  void note(const std::vector<threads::Grant>& grants) {
    for (const threads::Grant& grant : grants) {
      if (!grant.granted) refusals += threads::to_line(grant) + "\n";
    }
  }
  void hand_out(const OnFrame& on_frame) {
    auto& slots = *parts->thread.points();
    hand_out_sectors();
    for (live::FramePool<points::LabelledPoint>::Frame taken; slots.take(taken);) {
      hand_out_sectors();  // those of a frame come before it
      take_apart(taken.items);
      Frame frame{.number = taken.record.info.number,
                  .first_packet_ns = taken.record.info.first_packet_ns,
                  .last_packet_ns = taken.record.info.last_packet_ns,
                  .complete = taken.record.info.complete,
                  .deskewed = taken.record.info.deskew.state == frame::DeskewState::kDone,
                  .packets_lost = taken.record.info.losses.network_gap_packets,
                  .points = std::span<const Point>(points).first(taken.items.size()),
                  .labels = std::span<const Label>(labels).first(taken.items.size()),
                  .time_s = std::span<const float>(times_s).first(taken.items.size()),
                  .height_above_ground_m = taken.heights_m};
      if (scene != nullptr) {
        scene->find(taken.record.info, taken.items, taken.heights_m);
        frame.objects = scene->found().objects();
        frame.object_of_return = scene->found().object_of_return();
        frame.free_way = scene->found().free_way();
      }
      on_frame(frame);
      slots.give_back(true);
      ++figures.frames;
    }
  }
  void hand_out_sectors() {
    if (!on_sector) return;
    auto& slots = *parts->thread.sectors();
    for (live::SectorPool::Frame taken; slots.take(taken);) {
      take_apart(taken.items);
      std::span<const CompleteObject> objects;
      if (complete) objects = complete->take(taken.record, taken.items, taken.heights_m);
      on_sector({.frame = taken.record.frame,
                 .first_return = taken.record.first_return,
                 .first_packet_ns = taken.record.first_packet_ns,
                 .last_packet_ns = taken.record.last_packet_ns,
                 .labelled_ns = taken.record.labels_ns,
                 .points = std::span<const Point>(points).first(taken.items.size()),
                 .labels = std::span<const Label>(labels).first(taken.items.size()),
                 .height_above_ground_m = taken.heights_m,
                 .objects = objects});
      slots.give_back(true);
      ++figures.sectors;
    }
  }
  void take_apart(std::span<const points::LabelledPoint> items) {
    for (std::size_t i = 0; i < items.size(); ++i) {
      const points::LabelledPoint& point = items[i];
      points[i] = {point.x_m, point.y_m, point.z_m, point.row, point.intensity};
      labels[i] = point.label;
      times_s[i] = point.time_s;
    }
  }
  void judge() {
    for (status::FrameRecord frame; parts->thread.take_record(frame);) {
      parts->monitor.judge(frame);
      figures.deadlines_missed += frame.missed ? 1 : 0;
    }
  }

  std::unique_ptr<memory::FixedMemory> source_memory;  ///< The socket's buffers.
  memory::FixedMemory memory;
  net::LiveSource source;
  streams::SensorOnAir sensor;
  std::optional<FoundMount> found_mount;
  scene::Wanted wanted;
  OnSector on_sector;                            ///< May be empty.
  std::unique_ptr<points::SceneOfPoints> scene;  ///< Null unless anything is to be found.
  /// Null unless objects are to come with sectors.
  std::unique_ptr<points::CompleteObjects> complete;
  std::unique_ptr<live::LiveParts> parts;
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
  if (config.calibration) {
    const auto model = calib::model_of(config.calibration->table().unit);
    listen_config.slot_bytes =
        std::max(listen_config.slot_bytes, sensor::row_of(model).longest_packet_bytes);
  }
  auto source_memory = std::make_unique<memory::FixedMemory>();
  auto source = net::LiveSource::open(listen_config, *source_memory);
  if (!source) return tl::unexpected(source.error());
  auto sensor = listen(*source, config, stop_wanted);
  if (!sensor) return tl::unexpected(sensor.error());
  source->accept_only(sensor->sender);
  const live::LiveConfig of_run = live_config_of(config, sensor->columns);
  std::optional<FoundMount> mount;
  if (config.find_mount) {
    const auto found =
        run::mount_on_air(*source, *sensor, of_run.decoder, run::kGroundPatience, stop_wanted)
            .certain();
    if (found) mount = public_mount(*found);
    if (!found && !config.guess_mount) return tl::unexpected(mount_not_found(found.error()));
  }
  std::vector<threads::Grant> grants;
  if (config.lock_memory) grants = memory::hold_memory({});
  auto engine = std::make_unique<Engine>(std::move(source_memory), *std::move(source),
                                         *std::move(sensor), mount, config);
  const auto built = made([&] {
    return engine->build(of_run, mount ? mount->mount : config.mount, config.lock_memory, grants);
  });
  if (!built) return tl::unexpected(built.error());
  if (!*built) return tl::unexpected(built->error());
  engine->note(grants);
  return LiveRun(std::move(engine));
}

Sensor LiveRun::sensor() const noexcept {
  return sensor::sensor_of(engine_->sensor.model);
}

const std::optional<FoundMount>& LiveRun::found_mount() const noexcept {
  return engine_->found_mount;
}

const std::string& LiveRun::refusals() const noexcept {
  return engine_->refusals;
}

void LiveRun::run(const StopWanted& stop_wanted, const OnFrame& on_frame) {
  Engine& of = *engine_;
  of.note(of.parts->start());
  constexpr std::int64_t kAWhile_ns = 50'000'000;
  while (!stop_wanted()) {
    (void)of.parts->thread.points_ready().wait(-1, kAWhile_ns);
    of.hand_out(on_frame);
    of.judge();
  }
  of.parts->stop();
  of.hand_out(on_frame);
  of.judge();
}

LiveRun::Figures LiveRun::figures() const noexcept {
  Figures figures = engine_->figures;
  const status::InputState& intake = engine_->parts->thread.intake();
  figures.datagrams = intake.account.source.received;
  figures.decoded = intake.account.decoded;
  figures.frames_left_out = engine_->parts->thread.points()->unused();
  if (engine_->on_sector) figures.sectors_left_out = engine_->parts->thread.sectors()->unused();
  return figures;
}

}  // namespace terracut
