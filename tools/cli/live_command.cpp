// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "calib/hdl64e_file.hpp"
#include "calib/hdl64e_stream_table.hpp"
#include "calib/nominal_ruby128.hpp"
#include "calib/ruby128_csv.hpp"
#include "chrome_trace.hpp"
#include "commands.hpp"
#include "console.hpp"
#include "dump_answer.hpp"
#include "dump_signal.hpp"
#include "firmware_io/capture/sensor_probe.hpp"
#include "firmware_io/hdl64e/status_stream_reader.hpp"
#include "firmware_io/hdl64e/wire.hpp"
#include "firmware_io/sinks/label_sink.hpp"
#include "live_options.hpp"
#include "live_summary.hpp"
#include "live_threads.hpp"
#include "loss_table.hpp"
#include "metrics_server.hpp"
#include "rt/deadline_monitor.hpp"
#include "rt/locked_memory.hpp"
#include "rt/status_page.hpp"
#include "setup_choice.hpp"

namespace terracut::cli {
namespace {

using firmware_io::SensorModel;
using firmware_io::UdpSource;
using SteadyClock = std::chrono::steady_clock;

volatile std::sig_atomic_t interrupted = 0;

void end_on_signals() {
  struct sigaction action{};
  action.sa_handler = [](int) { interrupted = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // a second one kills
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

// --- Before the first turn: which sensor, which calibration ---

/// What the first seconds of the stream told.
struct Listened {
  firmware_io::SensorProbe probe;
  firmware_io::StatusStreamReader status;
};

/// Listens until the sensor is known and, where no calibration was given, an HDL-64E has sent its
/// own; at most `patience_s`.
Listened listen(UdpSource& source, bool want_table, double patience_s) {
  Listened heard;
  const auto end = SteadyClock::now() + std::chrono::duration<double>(patience_s);
  const auto knows = [&] {
    if (heard.probe.knows(SensorModel::kRuby128)) return true;
    return heard.probe.knows(SensorModel::kHdl64e) && (!want_table || heard.status.has_table());
  };
  while (!knows() && SteadyClock::now() < end && interrupted == 0) {
    for (const firmware_io::Datagram& datagram : source.receive(100'000'000)) {
      heard.probe.add(datagram.payload);
      const auto packet = firmware_io::Hdl64ePacketView::of(datagram.payload);
      if (packet && packet->is_hdl64e()) {
        heard.status.add(packet->status_type(), packet->status_value(), packet->stamp_us());
      }
    }
  }
  return heard;
}

Expected<SensorModel> sensor_of(const std::string& wanted, const firmware_io::SensorProbe& probe) {
  for (const auto& [name, model] :
       {std::pair{"hdl64e", SensorModel::kHdl64e}, std::pair{"ruby128", SensorModel::kRuby128}}) {
    if ((wanted == "auto" || wanted == name) && probe.packets_of(model) > 0) return model;
  }
  const std::string foreign = probe.foreign_models();
  return fail(ErrorCode::kUnsupported,
              fmt::format("no data packets of {} came within a few seconds: {}",
                          wanted == "auto" ? "an HDL-64E or RS-Ruby128" : wanted,
                          foreign.empty() ? "nothing that is known here; `terracut doctor` and "
                                            "tcpdump tell whether anything arrives at all"
                                          : foreign));
}

Expected<calib::SensorCalibration> calibration_of(const CaptureOptions& options, SensorModel model,
                                                  const Listened& heard) {
  if (model == SensorModel::kRuby128) {
    if (!options.calibration.empty()) return calib::read_ruby128_csv(options.calibration);
    if (options.nominal_calibration) return calib::nominal_ruby128();
    return fail(ErrorCode::kNoCalibration,
                "an RS-Ruby128 sends its angles to another port than its data: give the unit's "
                "angle.csv with --calibration FILE, or consent to the model's table with "
                "--nominal-calibration");
  }
  if (!options.calibration.empty()) return calib::load_hdl64e_calibration(options.calibration);
  if (!heard.status.has_table()) {
    return fail(ErrorCode::kNoCalibration,
                fmt::format("none was given, and {} bytes of the table in the packets are missing; "
                            "give the unit's db.xml or yaml with --calibration FILE",
                            heard.status.holes()));
  }
  auto table = calib::parse_stream_table(heard.status.table());
  if (!table) return tl::unexpected(table.error());
  return std::move(table->calibration);
}

// --- While it runs: everything that has no deadline ---

/// Judges frames, keeps the figures where others can see them, and writes what is to be written.
class Watch {
 public:
  Watch(const LiveOptions& options, LiveThreads& threads, firmware_io::FlightRecorder* recorder,
        rt::FixedMemory& memory)
      : options_(options),
        threads_(threads),
        recorder_(recorder),
        monitor_({.deadline_ns = static_cast<std::int64_t>(options.deadline_ms * 1e6),
                  .stage_names = stage_names_,
                  .kept_frames = kKeptFrames},
                 memory),
        shown_(std::make_unique<rt::MonitorSnapshot>()) {}

  /// Status page, metrics, dump folder: what fails is said, and the run goes on without it.
  void open(const std::string& sensor, const std::string& input) {
    rt::MonitorSnapshot& figures = monitor_.snapshot();
    figures.version = {TERRACUT_VERSION};
    figures.sensor = {sensor};
    figures.input = {input};
    figures.started_ns = rt::realtime_ns();
    auto page = rt::StatusPagePublisher<rt::MonitorSnapshot>::create(options_.watch.name,
                                                                     rt::MonitorSnapshot::kLayout);
    if (page) {
      page_.emplace(*std::move(page));
    } else {
      warn("no status page: " + page.error().message);
    }
    if (options_.watch.metrics != "off") open_metrics();
    if (!options_.recorder.folder.empty() && recorder_ != nullptr) {
      policy_.emplace(firmware_io::DumpLimits{
          .folder = {.folder = options_.recorder.folder, .name = options_.watch.name}});
      answers_.emplace(rt::status_page_folder(), options_.watch.name);
    }
    refresh();
  }

  /// What has come since the last call.
  void turn_round(DumpSignal& dump_wanted) {
    bool missed = false;
    for (rt::FrameTiming timing; threads_.take_timing(timing);) {
      timing.published_ns = rt::realtime_ns();
      monitor_.judge(timing);
      missed |= timing.missed;
    }
    for (LiveThreads::Labels labels; threads_.take_labels(labels); threads_.give_back()) {
      write(labels);
    }
    refresh();
    if (dump_wanted.take()) dump(firmware_io::DumpReason::kAsked);
    if (missed) dump(firmware_io::DumpReason::kMissedDeadline);
  }

  [[nodiscard]] const rt::MonitorSnapshot& figures() const noexcept { return monitor_.snapshot(); }
  [[nodiscard]] const Status& sink() const noexcept { return sink_; }
  [[nodiscard]] std::vector<rt::FrameTiming> newest() const {
    std::vector<rt::FrameTiming> frames(kKeptFrames);
    frames.resize(monitor_.copy_newest(frames));
    return frames;
  }

 private:
  static constexpr std::size_t kKeptFrames = 256;
  static constexpr std::array<std::string_view, pipeline::kStages> stage_names_{
      to_string(pipeline::Stage::kElevationMap), to_string(pipeline::Stage::kAdjacentPoints),
      to_string(pipeline::Stage::kSeeds), to_string(pipeline::Stage::kMinCut),
      to_string(pipeline::Stage::kLabels)};

  void open_metrics() {
    const auto at = firmware_io::parse_ipv4_endpoint(options_.watch.metrics);
    if (!at) {
      warn("no /metrics: " + at.error().message);
      return;
    }
    auto server = MetricsServer::start(firmware_io::ipv4_text(at->address), at->port,
                                       [this](rt::MonitorSnapshot& figures) {
                                         const std::scoped_lock lock(shown_mutex_);
                                         figures = *shown_;
                                         return true;
                                       });
    if (server) {
      metrics_.emplace(*std::move(server));
    } else {
      warn("no /metrics: " + server.error().message);
    }
  }

  void refresh() {
    rt::MonitorSnapshot& figures = monitor_.snapshot();
    figures.taken_ns = rt::realtime_ns();
    const std::uint64_t packets = threads_.packets();
    if (packets != figures.packets) figures.last_packet_ns = figures.taken_ns;
    figures.packets = packets;
    constexpr std::int64_t kSilence_ns = 1'000'000'000;
    figures.link = packets == 0 ? rt::LinkState::kWaiting
                   : figures.taken_ns - figures.last_packet_ns > kSilence_ns
                       ? rt::LinkState::kSilent
                       : rt::LinkState::kReceiving;
    firmware_io::LossCounters losses = threads_.losses();
    losses.skipped_frames = figures.rungs[static_cast<std::size_t>(rt::Rung::kSkipped)];
    show_losses(losses, figures);
    show_thread(figures, 0, "receive", threads_.receive_faults());
    show_thread(figures, 1, "segment", threads_.segment_faults());
    figures.thread_count = 2;
    if (page_) page_->publish(figures);
    const std::scoped_lock lock(shown_mutex_);
    *shown_ = figures;
  }

  static void show_thread(rt::MonitorSnapshot& figures, std::size_t i, std::string_view name,
                          const LiveThreads::Faults& faults) {
    figures.threads[i].name = {name};
    figures.threads[i].minor_faults = static_cast<std::uint64_t>(faults.minor.load());
    figures.threads[i].major_faults = static_cast<std::uint64_t>(faults.major.load());
  }

  void write(const LiveThreads::Labels& labels) {
    if (!sink_) return;
    sink_ = firmware_io::write_label_file(
        options_.labels / fmt::format("{:06}.label", labels.number), labels.labels);
    if (!sink_) warn("no more labels are written: " + sink_.error().message);
  }

  void dump(firmware_io::DumpReason reason) {
    if (!policy_) return;
    const std::vector<rt::FrameTiming> frames = newest();
    const auto outcome = recorder_->dump(*policy_, reason, {frames, stage_names_});
    if (outcome) {
      say(fmt::format("dumped {} datagrams to {}", outcome->datagrams, outcome->capture.string()));
    } else if (outcome.error().refusal != firmware_io::DumpRefusal::kTooSoon) {
      warn("not dumped: " + outcome.error().message);
    }
    if (reason == firmware_io::DumpReason::kAsked) {
      if (const Status told = answers_->publish(outcome); !told) warn(told.error().message);
    }
  }

  const LiveOptions& options_;
  LiveThreads& threads_;
  firmware_io::FlightRecorder* recorder_;
  rt::DeadlineMonitor monitor_;
  std::optional<rt::StatusPagePublisher<rt::MonitorSnapshot>> page_;
  std::mutex
      shown_mutex_;  ///< Between this thread and the metrics server's; neither has a deadline.
  std::unique_ptr<rt::MonitorSnapshot> shown_;
  std::optional<firmware_io::DumpPolicy> policy_;
  std::optional<DumpAnswers> answers_;
  Status sink_;
  std::optional<MetricsServer> metrics_;  ///< Last: it reads shown_ until it is gone.
};

void say_refusals(const std::vector<rt::Grant>& grants) {
  for (const rt::Grant& grant : grants) {
    if (!grant.granted) warn(to_line(grant));
  }
}

/// What a sensor sends a second at most: an RS-Ruby128 in dual return.
constexpr double kMostPacketsPerSecond = 12'001;
constexpr std::size_t kLongestPacketBytes = 1248;

/// Everything that takes memory, built twice: once to learn how much, once in the locked region.
struct LiveParts {
  PacketChain chain;
  std::optional<firmware_io::FlightRecorder> recorder;

  LiveParts(const calib::SensorCalibration& calibration, const calib::RingProfile& profile,
            int columns, const LiveOptions& options, rt::FixedMemory& memory)
      : chain(calibration, profile, columns, options.capture, options.method, memory,
              FrameExchange::kImages) {
    if (options.recorder.seconds > 0 && !options.recorder.folder.empty()) {
      recorder.emplace(firmware_io::packet_ring_size(options.recorder.seconds,
                                                     kMostPacketsPerSecond, kLongestPacketBytes),
                       memory);
    }
  }
};

ExitCode conclude(const LiveOptions& options, const Watch& watch, std::uint64_t labels_dropped) {
  const rt::MonitorSnapshot& figures = watch.figures();
  const auto ms = [](std::int64_t ns) { return static_cast<double>(ns) * 1e-6; };
  fmt::print("frames    {} of {} packets\nmissed    {} deadlines of {:.0f} ms\n", figures.frames,
             figures.packets, figures.all_misses(), options.deadline_ms);
  fmt::print(
      "latency   {:.2f} ms p50, {:.2f} p99, {:.2f} max; processor time {:.2f} p50, {:.2f} "
      "p99, {:.2f} max\n",
      ms(figures.latency.percentile_ns(50)), ms(figures.latency.percentile_ns(99)),
      ms(figures.latency.max_ns()), ms(figures.total_cpu.percentile_ns(50)),
      ms(figures.total_cpu.percentile_ns(99)), ms(figures.total_cpu.max_ns()));
  std::string losses;
  for (const rt::NamedCount& loss : figures.losses_in_use()) {
    if (loss.count > 0)
      losses += fmt::format("{}{} {}", losses.empty() ? "" : ", ", loss.name.view(), loss.count);
  }
  fmt::print("losses    {}\n", losses.empty() ? "none" : losses);
  if (labels_dropped > 0) {
    warn(
        fmt::format("labels of {} frames were not written: the disk was too slow", labels_dropped));
  }
  if (!options.json.empty()) {
    if (const Status written = write_live_summary(options.json, figures); !written) {
      return refuse(written.error());
    }
  }
  if (!options.trace.empty()) {
    if (const Status written = write_chrome_trace(options.trace, figures, watch.newest());
        !written) {
      return refuse(written.error());
    }
  }
  if (!watch.sink()) return kOutputFailed;
  if (figures.frames == 0) return kNothingCameOut;
  return figures.all_misses() > 0 ? kDeadlinesMissed : kOk;
}

}  // namespace

ExitCode run(const LiveOptions& options) {
  DumpSignal dump_wanted;  // before any thread: they inherit that the signal is blocked
  end_on_signals();
  if (options.realtime.lock_memory) say_refusals(rt::hold_memory({}));

  const auto listen_at = firmware_io::parse_ipv4_endpoint(options.listen.address);
  if (!listen_at) return refuse(listen_at.error());
  firmware_io::UdpSourceConfig config{.bind = *listen_at,
                                      .interface = options.listen.interface,
                                      .share_port = options.listen.share_port};
  for (const auto& [text, into] : {std::pair{&options.listen.multicast, &config.multicast_group},
                                   std::pair{&options.capture.from, &config.source_address}}) {
    if (text->empty()) continue;
    const auto address = firmware_io::parse_ipv4_address(*text);
    if (!address) return refuse(address.error());
    *into = *address;
  }
  rt::FixedMemory socket_memory;
  auto source = UdpSource::open(config, socket_memory);
  if (!source) return refuse(source.error());
  for (const std::string& warning : source->warnings()) warn(warning);
  const std::string input = to_string(source->local());
  say("listening at " + input);

  constexpr double kPatience_s = 5;
  const Listened heard = listen(*source, options.capture.calibration.empty(), kPatience_s);
  const auto model = sensor_of(options.capture.sensor, heard.probe);
  if (!model) return refuse(model.error());
  const auto calibration = calibration_of(options.capture, *model, heard);
  if (!calibration) return refuse(calibration.error());
  const auto profile = ring_profile_of(*calibration, options.mount);
  if (!profile) return refuse(profile.error());
  const int columns = options.capture.columns.value_or(heard.probe.columns(*model));
  const std::string sensor =
      fmt::format("{}, {:.1f} Hz, {} return", to_string(*model), heard.probe.spin_hz(*model),
                  heard.probe.dual_return(*model) ? "dual" : "single");
  say(fmt::format("sensor: {}, {} columns", sensor, columns));
  say(fmt::format("calibration: {}, fingerprint {:016x}", origin_of(*calibration),
                  calib::fingerprint(*calibration)));

  auto ready = firmware_io::WakeEvent::make();
  if (!ready) return refuse(ready.error());
  rt::FixedMemory plan, memory;
  {
    LiveParts trial(*calibration, *profile, columns, options, plan);
    auto idle = firmware_io::WakeEvent::make();
    if (!idle) return refuse(idle.error());
    LiveThreads threads(options, trial.chain, *source, *std::move(idle), nullptr, plan);
    Watch watch(options, threads, nullptr, plan);
  }
  auto region = memory.reserve(plan.total_bytes(), {.lock = options.realtime.lock_memory});
  if (!region) return refuse(region.error());
  say_refusals(*region);
  LiveParts parts(*calibration, *profile, columns, options, memory);
  firmware_io::FlightRecorder* recorder = parts.recorder ? &*parts.recorder : nullptr;
  LiveThreads threads(options, parts.chain, *source, *std::move(ready), recorder, memory);
  Watch watch(options, threads, recorder, memory);
  if (const Status fits = memory.within_plan(); !fits) return refuse(fits.error());

  watch.open(sensor, input);
  say_refusals(threads.start());
  const auto started = SteadyClock::now();
  const auto is_over = [&] {
    return options.capture.duration_s &&
           SteadyClock::now() - started >
               std::chrono::duration<double>(*options.capture.duration_s);
  };
  while (interrupted == 0 && !is_over()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    watch.turn_round(dump_wanted);
  }
  threads.stop();
  watch.turn_round(dump_wanted);
  return conclude(options, watch, threads.labels_dropped());
}

}  // namespace terracut::cli
