// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dump_signal.hpp"
#include "dump_writer.hpp"
#include "figures_display.hpp"
#include "firmware_io/net/ipv4_endpoint.hpp"
#include "label_writer.hpp"
#include "listening.hpp"
#include "live_service.hpp"
#include "live_watch.hpp"
#include "pipeline/live/frame_outlet.hpp"
#include "pipeline/live/live_parts.hpp"
#include "rt/caught.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "rt/memory/locked_memory.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/export/chrome_trace.hpp"
#include "tools/cli/export/door_news.hpp"
#include "tools/cli/figures/dashboard.hpp"
#include "tools/cli/figures/figures_json.hpp"
#include "tools/cli/input/input_check.hpp"
#include "tools/cli/json_text.hpp"
#include "tools/cli/live/live_mount.hpp"
#include "tools/cli/output/output_sinks.hpp"
#include "tools/cli/settings/decoder_choice.hpp"
#include "tools/cli/settings/motion_choice.hpp"
#include "tools/cli/settings/sensor_choice.hpp"
#include "tools/cli/settings/setup_choice.hpp"
#include "tools/cli/stop_signal.hpp"
#include "vehicle_bus.hpp"

namespace terracut::cli {
namespace {

using SteadyClock = std::chrono::steady_clock;

void say_refusals(const std::vector<threads::Grant>& grants) {
  for (const threads::Grant& grant : grants) {
    if (!grant.granted) warn(to_line(grant));
  }
}

[[nodiscard]] bool keeps_packets(const Options& options) {
  return options.recorder.seconds > 0 && !options.recorder.folder.empty();
}

Expected<net::LiveSource> open_source(const Options& options, memory::FixedMemory& memory) {
  auto source = net::LiveSource::open(listen_config_of(options), memory);
  if (!source) return source;
  for (const std::string& warning : source->warnings()) warn(warning);
  say("listening at " + source->name());
  return source;
}

std::string describe(const streams::SensorOnAir& sensor) {
  return fmt::format("{} at {}, {:.1f} Hz, {} return", to_string(sensor.model),
                     to_string(sensor.sender), sensor.spin_hz,
                     sensor.dual_return ? "dual" : "single");
}

/// Returns the answer to requests for a dump in a run that keeps no packets.
recorder::RefusedDump nothing_to_dump(const Options& options) {
  if (keeps_packets(options)) {
    return {recorder::DumpRefusal::kNothingHeld,
            "labelling has not begun, and packets are kept from then on; `terracut top` shows what "
            "is waited for"};
  }
  return {recorder::DumpRefusal::kNoRecorder,
          "this run keeps no packets; start it with --recorder-folder FOLDER (and "
          "--recorder-seconds above 0)"};
}

void refuse_dump(const Options& options, DumpAnswers& answers) {
  const Status told = answers.publish(tl::unexpected(nothing_to_dump(options)));
  if (!told) warn(told.error().message);
}

/// Shows what a run waits for before it has heard its sensor.
class Waiting {
 public:
  Waiting(const Options& options, const net::LiveSource& source, FiguresDisplay& display,
          LiveService& service, DumpSignal& dump_wanted, DumpAnswers& answers)
      : options_(options),
        source_(source),
        display_(display),
        service_(service),
        dump_wanted_(dump_wanted),
        answers_(answers) {
    figures_->version = {TERRACUT_VERSION};
    figures_->input = {source.name()};
    figures_->started_ns = measure::realtime_ns();
    figures_->deadline_ns = static_cast<std::int64_t>(options.deadline_ms * 1e6);
    show("waiting for a sensor");
    service_.ready(*figures_, measure::monotonic_ns());
  }

  void work_round(const std::string& what) {
    show(what);
    service_.work_round(*figures_, measure::monotonic_ns());
    if (dump_wanted_.take()) refuse_dump(options_, answers_);
    // A short wait is not printed, and text is not repeated too often, as counts in it change all
    // the time.
    const std::int64_t now_ns = measure::monotonic_ns();
    if (now_ns < say_at_ns_ || what == said_) return;
    say(what + " (Ctrl-C ends it)");
    said_ = what;
    say_at_ns_ = now_ns + kSayEvery_ns;
  }

  /// Ends a run that was stopped before labelling began.
  [[nodiscard]] ExitCode end() const {
    fmt::print("{}", closing_lines(*figures_));
    const Status written = write_json(options_.output.json, live_summary(*figures_));
    if (!written) return refuse(written.error());
    return options_.capture.duration_s ? kInterrupted : kOk;
  }

 private:
  static constexpr std::int64_t kSayFirst_ns = 2'000'000'000, kSayEvery_ns = 30'000'000'000;

  void show(const std::string& what) {
    figures_->sensor = {what};
    figures_->taken_ns = measure::realtime_ns();
    const std::uint64_t heard = source_.counters().received;
    if (heard != intake_.before_labelling) intake_.newest_packet_ns = figures_->taken_ns;
    intake_.before_labelling = heard;
    intake_.link = source_.link();
    if (const std::string news = input_.show(intake_, *figures_); !news.empty()) say(news);
    display_.show(*figures_);
  }

  const Options& options_;
  const net::LiveSource& source_;
  FiguresDisplay& display_;
  LiveService& service_;
  DumpSignal& dump_wanted_;
  DumpAnswers& answers_;
  status::InputState intake_;
  status::InputStatus input_;
  std::unique_ptr<status::MonitorSnapshot> figures_ = std::make_unique<status::MonitorSnapshot>();
  std::string said_;
  std::int64_t say_at_ns_ = measure::monotonic_ns() + kSayFirst_ns;
};

/// Returns the configuration that the options ask for. `bus` may be null.
live::LiveConfig live_config_of(const Options& options, const streams::SensorOnAir& sensor,
                                VehicleBus* bus) {
  const RealtimeOptions& realtime = options.realtime;
  const bool wants_points =
      !options.stream.empty() || wants_sinks(options.output) || options.method.scene.sight;
  live::LiveConfig config;
  config.decoder = decoder_config_of(options, sensor.columns);
  config.reorder_packets = options.capture.reorder_packets.value_or(config.reorder_packets);
  config.method = method_config_of(options.method).segmenter;
  config.thread = {
      .deadline_ns = static_cast<std::int64_t>(options.deadline_ms * 1e6),
      .longest_gathering_ns = static_cast<std::int64_t>(options.listen.gather_ms * 1e6),
      .keeps_labels = !options.output.labels.empty(),
      .keeps_points = wants_points,
      .keeps_sectors = wants_sectors(options.output) || options.stream_sectors,
      .compares_tables = !options.capture.calibration.empty(),
      .thread = live::thread_request("tc-label", realtime.priority, realtime.core)};
  config.recorder_seconds = keeps_packets(options) ? options.recorder.seconds : 0;
  if (bus != nullptr) {
    config.vehicle = {&bus->signals, &bus->source, ego_motion_config_of(options.motion),
                      realtime.can_priority};
  }
  return config;
}

/// The outputs of a run, on threads that no other thread waits for.
class Writers {
 public:
  /// `answers` publishes the outcomes of dumps for those who asked for one.
  explicit Writers(DumpAnswers& answers) noexcept : answers_(answers) {}

  /// Opens the outputs. An output that fails is tried again as long as the run goes on.
  void open(const Options& options, const streams::SensorOnAir& sensor,
            const mount::RingProfile& profile, live::LiveParts& parts) {
    const auto deadline_ns = static_cast<std::int64_t>(options.deadline_ms * 1e6);
    publisher_.emplace(
        retried_sinks(options.output,
                      {.sensor = describe(sensor),
                       .rows = parts.turns.decoder().shape().rows,
                       .mount = profile.mount,
                       .deadline_ns = deadline_ns,
                       .gives_sectors = true,
                       .has_road = method_config_of(options.method).segmenter.road.enabled,
                       .found = options.method.scene}),
        publish::WhenFull::kDropOldest, warn_of_failure);
    if (parts.thread.points()) {
      std::optional<live::FrameOutlet::Stream> stream;
      if (!options.stream.empty()) {
        stream = {publish::Reopened<stream::FrameStreamServer>(stream_at(options, parts)),
                  sensor.model, deadline_ns, options.stream_sectors, options.method.scene.objects};
      }
      const decode::Decoder& decoder = parts.turns.decoder();
      const auto finder_of = [&](scene::Wanted wanted) -> std::unique_ptr<points::SceneOfPoints> {
        if (!wanted.any()) return nullptr;
        return std::make_unique<points::SceneOfPoints>(
            wanted, profile, decoder.shape(), decoder.return_capacity(), decoder.beam_turns());
      };
      const scene::Wanted wanted = options.method.scene;
      live::FrameOutlet::Finders finders{.scene = finder_of(wanted.without_sight()),
                                         .sight = finder_of({.sight = wanted.sight})};
      if (wanted.objects && wants_sector_objects(options.output)) {
        finders.complete = std::make_unique<points::CompleteObjects>(profile, decoder.shape(),
                                                                     decoder.return_capacity());
      }
      outlet_.emplace(std::move(stream), *publisher_, *parts.thread.points(),
                      parts.thread.sectors(), parts.thread.points_ready(), std::move(finders));
    }
    if (parts.thread.labels()) labels_.emplace(options.output, *parts.thread.labels());
    if (parts.recorder) {
      dumps_.emplace(options, sensor.calibration, *parts.recorder, stage::kStageNames, answers_);
    }
  }

  /// Returns the outlet after open(); null if only labels are written.
  [[nodiscard]] const live::FrameOutlet* outlet() const { return outlet_ ? &*outlet_ : nullptr; }
  [[nodiscard]] publish::Publisher& publisher() { return *publisher_; }

  void want_dump(recorder::DumpReason reason, const Options& options, const LiveWatch& watch) {
    if (dumps_) {
      dumps_->want(reason, watch.newest());
    } else if (reason == recorder::DumpReason::kAsked) {
      refuse_dump(options, answers_);
    }
  }

  /// Ends the outputs. Returns false if the disk or another output does not answer in time.
  [[nodiscard]] bool finish() {
    constexpr std::chrono::seconds kPatience{3};
    const bool frames_done = !outlet_ || outlet_->finish(kPatience);
    const bool outputs_done = frames_done && publisher_->finish(kPatience);
    const bool labels_done = !labels_ || labels_->finish(kPatience);
    const bool dumps_done = !dumps_ || dumps_->finish(kPatience);
    return outputs_done && labels_done && dumps_done;
  }
  /// True if everything was written. Valid after finish().
  [[nodiscard]] bool wrote_all() const {
    return publisher_->outcome() && (!labels_ || labels_->outcome());
  }

 private:
  [[nodiscard]] publish::Reopened<stream::FrameStreamServer>::Config stream_at(
      const Options& options, const live::LiveParts& parts) {
    const stream::FrameStreamConfig config{
        .address = stream::parse_stream_address(options.stream).value(),
        .unix_mode = options.stream_mode,
        .max_points = parts.turns.decoder().return_capacity(),
        .serves_sectors = options.stream_sectors,
        .has_heights = options.method.gives_heights(),
        .has_objects = options.method.scene.objects};
    const auto open = [this, config]() -> Expected<stream::FrameStreamServer> {
      auto server = stream::FrameStreamServer::open(config, stream_memory_);
      if (!server) return server;
      if (!server->send_buffer().granted) warn(to_line(server->send_buffer()));
      say("labelled points at " + to_string(server->address()));
      return server;
    };
    return {.open = open,
            .on_news = [](const Status& now) { tell_of_door("stream of labelled points", now); }};
  }

  DumpAnswers& answers_;
  /// Used only by the outlet's thread, so it is not locked into memory: that thread has no
  /// deadline.
  memory::FixedMemory stream_memory_;
  std::optional<publish::Publisher> publisher_;
  std::optional<live::FrameOutlet> outlet_;
  std::optional<LabelWriter> labels_;
  std::optional<DumpWriter> dumps_;
};

void run_until_stopped(const Options& options, const streams::SensorOnAir& sensor,
                       live::LiveParts& parts, LiveWatch& watch, Writers& writers,
                       DumpSignal& dump_wanted, LiveService& service) {
  const auto started = SteadyClock::now();
  const auto is_over = [&] {
    return options.capture.duration_s &&
           SteadyClock::now() - started >
               std::chrono::duration<double>(*options.capture.duration_s);
  };
  while (!stop_wanted() && !is_over()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    const LiveWatch::Round round = watch.work_round();
    service.work_round(watch.figures(), measure::monotonic_ns());
    const std::string other = parts.thread.told_table().take_warning(sensor.calibration);
    if (!other.empty()) warn(other);
    if (round.missed > 0) writers.want_dump(recorder::DumpReason::kMissedDeadline, options, watch);
    if (dump_wanted.take()) writers.want_dump(recorder::DumpReason::kAsked, options, watch);
  }
  if (options.capture.duration_s && !is_over()) watch.note_interruption();
}

ExitCode conclude(const Options& options, const LiveWatch& watch) {
  const status::MonitorSnapshot& figures = watch.figures();
  print_text(closing_lines(figures));
  Status written = write_json(options.output.json, live_summary(figures));
  if (written) written = write_json(options.trace, chrome_trace(figures, watch.newest()));
  if (!written) return refuse(written.error());
  if (figures.interrupted != 0) return kInterrupted;
  if (figures.frames == 0) return refuse(kNothingCameOut, why_no_frames(figures));
  return figures.all_misses() > 0 ? kDeadlinesMissed : kOk;
}

}  // namespace

ExitCode run_live(const Options& options) {
  if (const Status ready = check_inputs(options); !ready) return refuse(ready.error());
  if (const Status sinks = check_sinks(options.output); !sinks) return refuse(sinks.error());
  DumpSignal dump_wanted;  // made before all threads, which inherit the blocked signal
  write_in_background();
  catch_stop_signals();
  if (options.realtime.lock_memory) say_refusals(memory::hold_memory({}));

  memory::FixedMemory socket_memory;
  LiveService service = LiveService::from_environment();
  if (!options.recorder.folder.empty()) {
    const auto usable = recorder::DumpFolder(dump_folder_of(options)).check();
    if (!usable) warn("no dumps as long as this is so: " + usable.error().message);
  }
  auto source = open_source(options, socket_memory);
  if (!source) return refuse(source.error());
  std::optional<vehicle::MotionSignals> signals;
  if (!options.can.empty()) {
    auto found = motion_signals_of(options.motion);
    if (!found) return refuse(found.error());
    signals = *std::move(found);
  }
  FiguresDisplay display(options.watch);
  DumpAnswers dump_answers(page::status_page_folder(), options.watch.name);
  Waiting waiting(options, *source, display, service, dump_wanted, dump_answers);
  const auto sensor = listen_for_sensor(*source, options,
                                        [&](const std::string& what) { waiting.work_round(what); });
  if (stop_wanted()) return waiting.end();
  if (!sensor) return refuse(sensor.error());
  source->accept_only(sensor->sender);
  say("sensor: " + describe(*sensor));
  warn_of_unused(options.capture, sensor->model);
  say(fmt::format("calibration: {}, fingerprint {:016x}", calib::origin_of(sensor->calibration),
                  calib::fingerprint(sensor->calibration)));
  const MountChoice mount = mount_on_air(
      *source, *sensor, options, [&](const std::string& what) { waiting.work_round(what); });
  if (stop_wanted()) return waiting.end();
  const auto profile = ring_profile_of(sensor->calibration, mount.options);
  if (!profile) return refuse(profile.error());

  // Opens the bus only after the wait for the sensor; frames received during the wait would
  // overflow the socket.
  std::optional<VehicleBus> bus;
  if (signals) {
    auto opened = VehicleBus::open(options.can, *std::move(signals), socket_memory);
    if (!opened) return refuse(opened.error());
    bus.emplace(*std::move(opened));
  }

  memory::FixedMemory memory;
  std::vector<threads::Grant> grants;
  const auto built =
      live::LiveParts::build(live_config_of(options, *sensor, bus ? &*bus : nullptr), *sensor,
                             *profile, *source, memory, options.realtime.lock_memory, grants);
  if (!built) return refuse(built.error());
  say_refusals(grants);
  live::LiveParts& parts = **built;
  LiveWatch watch(options, profile->mount, mount, parts, display);

  Writers writers(dump_answers);
  writers.open(options, *sensor, *profile, parts);
  say_refusals(parts.start());
  watch.open(describe(*sensor), source->name(), writers.outlet(), writers.publisher());
  const Status ran = rt::caught([&]() -> Status {
    run_until_stopped(options, *sensor, parts, watch, writers, dump_wanted, service);
    return {};
  });
  service.stopping();
  parts.stop();
  watch.work_round();
  const bool disk_answers = writers.finish();
  watch.last_round();
  ExitCode code = conclude(options, watch);
  if (!ran) code = refuse(ran.error());
  if (disk_answers) return writers.wrote_all() ? code : kOutputFailed;
  warn("the disk does not answer: what was not written by now is lost");
  // Ends the process at once: threads that wait for the disk cannot be ended otherwise.
  std::_Exit(end_output(kOutputFailed));
}

}  // namespace terracut::cli
