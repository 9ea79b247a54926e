// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "firmware_io/hdl64e/status_stream_reader.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "firmware_io/sensor/told_table.hpp"
#include "pipeline/run/latest_near_ground.hpp"
#include "pipeline/run/packet_pipeline.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/figures/mount_watch.hpp"
#include "tools/cli/figures/report.hpp"
#include "tools/cli/input/device_clock.hpp"
#include "tools/cli/input/frame_outputs.hpp"
#include "tools/cli/input/mount_choice.hpp"
#include "tools/cli/input/open_capture.hpp"
#include "tools/cli/input/recorded_frames.hpp"
#include "tools/cli/input/recorded_motion.hpp"
#include "tools/cli/settings/decoder_choice.hpp"
#include "tools/cli/settings/motion_choice.hpp"
#include "tools/cli/settings/setup_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

using frame::FrameInfo;

/// Sleeps so that datagrams come at `rate` times the speed of their stamps; 0 never sleeps. Where
/// the run is to stop it sleeps no longer than a moment.
class Pace {
 public:
  explicit Pace(double rate) : rate_(rate) {}

  void restart() noexcept { begun_ = false; }
  void wait_for(std::int64_t stamp_ns) {
    if (rate_ <= 0) return;
    const auto now = std::chrono::steady_clock::now();
    if (!begun_) {
      begun_ = true;
      first_ns_ = stamp_ns;
      started_ = now;
    }
    constexpr double kFar_ns = 9e18;  // a rate near 0 would leave the 64 bits
    const double due_ns = static_cast<double>(stamp_ns - first_ns_) / rate_;
    const auto due = started_ + std::chrono::nanoseconds(
                                    static_cast<std::int64_t>(std::clamp(due_ns, 0.0, kFar_ns)));
    constexpr std::chrono::milliseconds kMoment{100};
    for (auto at = now; at < due && !stop_wanted(); at = std::chrono::steady_clock::now()) {
      std::this_thread::sleep_until(std::min(due, at + kMoment));
    }
  }

 private:
  double rate_;
  bool begun_ = false;
  std::int64_t first_ns_ = 0;
  std::chrono::steady_clock::time_point started_;
};

/// The truth of one frame after the other, as far as there is any that fits.
class FrameTruth {
 public:
  explicit FrameTruth(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// One id a return, or empty: no truth asked for, or none that fits (said once).
  std::span<const std::uint32_t> read(const std::string& name, std::size_t returns) {
    labels_.clear();
    if (folder_.empty()) return labels_;
    const Status status = scan::read_label_file(folder_ / (name + ".label"), returns, labels_);
    if (status) return labels_;
    if (!warned_)
      warn("frames without fitting truth are not scored; the first: " + status.error().message);
    warned_ = true;
    labels_.clear();
    return labels_;
  }

 private:
  std::filesystem::path folder_;
  std::vector<std::uint32_t> labels_;
  bool warned_ = false;
};

/// A capture's way to labels, on one thread: source, decoder, segmenter, sinks.
class Replay {
 public:
  /// `motion` may be null: returns then lie where the sensor saw them.
  Replay(const Options& options, OpenCapture& capture, const mount::RingProfile& profile,
         const MountChoice& mount, RecordedMotion* motion)
      : options_(options),
        capture_(capture),
        motion_(motion),
        pipeline_(
            capture.calibration, profile,
            decoder_config_of(options, capture.sensor.columns,
                              FrameOutputs::need_points(options.output) ? FramesAreFor::kPoints
                                                                        : FramesAreFor::kLabels,
                              motion != nullptr ? &motion->motion() : nullptr),
            method_config_of(options.method), memory_),
        clock_of_device_(options.capture.clock_offset_s),
        outputs_(options.output),
        sensor_mount_(profile.mount),
        mount_(profile.mount, mount),
        truth_(options.output.truth),
        report_{"replay", options.capture.file.string(), capture.sensor_line,
                capture.calibration_line, options.method},
        progress_("replaying", "frames", 0) {}

  ExitCode run() {
    sinks_ = outputs_.open({.sensor = capture_.sensor_line,
                            .rows = pipeline_.decoder().shape().rows,
                            .mount = sensor_mount_,
                            .has_road = method_config_of(options_.method).segmenter.road.enabled});
    if (!sinks_) return refuse(sinks_.error());
    Pace pace(options_.replay.rate);
    for (int pass = 0; options_.replay.loops == 0 || pass < options_.replay.loops; ++pass) {
      if (pass > 0) {
        if (Status status = capture_.source.rewind(); !status) return refuse(status.error());
        if (motion_ != nullptr) {
          if (Status status = motion_->restart(); !status) return refuse(status.error());
        }
      }
      pace.restart();
      const std::uint64_t offered_before = offered_;
      const bool go_on = play_once(pace);
      pipeline_.end_stream();
      take_frames();
      if (!go_on || offered_ == offered_before) break;  // a pass without packets will stay without
    }
    return conclude();
  }

 private:
  /// False when the replay is over: a sink failed, Ctrl-C, or the capture broke off.
  bool play_once(Pace& pace) {
    CapturePart part(capture_.source, options_.capture);
    while (const decode::Datagram* datagram = sinks_ ? part.next() : nullptr) {
      pace.wait_for(datagram->stamp_ns);
      if (motion_ != nullptr) motion_->hear_until(datagram->stamp_ns);
      decode(*datagram);
    }
    // A replay without an end is not cut short by Ctrl-C.
    report_.interrupted = part.stopped() && options_.replay.loops != 0;
    report_.input_warning = part.fault();
    return sinks_ && !part.stopped() && part.fault().empty();
  }

  void decode(const decode::Datagram& datagram) {
    ++offered_;
    pipeline_.push(datagram);
    take_frames();
    if (pipeline_.rejected()) return;
    clock_of_device_.note(pipeline_.decoder(), datagram.stamp_ns);
    const auto* packet = hdl64e::packet_in(datagram.payload);
    if (packet != nullptr && hdl64e::is_hdl64e(*packet)) {
      status_.add(packet->status_type, packet->status_value, packet->stamp_us.value());
    }
  }

  void take_frames() {
    while (run::Frame* frame = pipeline_.next()) take(*frame);
  }

  /// Labels a frame and hands the labels to the sinks. A sink that fails is remembered, and
  /// play_once() ends the replay.
  void take(run::Frame& frame) {
    const FrameInfo& info = frame.record.info;
    const frame::RangeImage& image = *frame.image;
    pipeline_.label(frame);
    report_.add(frame.record);
    if (info.number % run::LatestNearGround::kFramesApart == 0) {
      pipeline_.take_near_ground(frame, *near_ground_);
      mount_.add_frame(*near_ground_);
    };

    const std::string name = fmt::format("{:06}", info.number);
    const std::span<const std::uint32_t> truth = truth_.read(name, image.returns());
    if (!truth.empty()) report_.score(pipeline_.labels(), truth);
    if (sinks_) sinks_ = outputs_.write_labels(name, pipeline_.labels());
    if (sinks_) sinks_ = outputs_.write_frame(name, image, pipeline_.labels(), truth);
    if (sinks_) {
      sinks_ = outputs_.publish(
          frame.record, image, pipeline_.labels(),
          stream::FrameTiming::of(frame.record.info, pipeline_.decoder().beam_turns()));
    }
    if (sinks_) {
      sinks_ = outputs_.write_returns(
          {info.number, info.first_packet_ns, image, pipeline_.height_m(), pipeline_.labels()});
    }
    progress_.update(static_cast<double>(report_.records.size()));
  }

  ExitCode conclude() {
    if (sinks_) sinks_ = outputs_.finish();
    if (!sinks_) return refuse(sinks_.error());
    const frame::LossCounters losses = pipeline_.decoder().losses();
    if (report_.records.empty() && report_.interrupted) {
      return refuse(kInterrupted, "interrupted before the first frame came out");
    }
    if (report_.records.empty()) {
      return refuse(nothing_came_out(capture_.source, offered_, losses));
    }
    if (const std::string other = sensor::other_table_warning(status_, capture_.calibration);
        !other.empty()) {
      warn(other);
    }
    warn_of_other_senders(capture_, capture_.source.counters(), options_.capture);
    report_.losses = losses;
    report_.blind = pipeline_.decoder().blind();
    report_.mount = mount_.figures();
    if (clock_of_device_.noted()) {
      report_.device_clock = clock_of_device_.text();
      if (const std::string warning = clock_of_device_.warning(); !warning.empty()) warn(warning);
    }
    if (motion_ != nullptr) {
      report_.motion_samples = motion_->samples();
      if (const std::string warnings = motion_->warnings(); !warnings.empty()) warn(warnings);
    }
    const ExitCode concluded = conclude_with(report_, options_.output.json);
    if (concluded != kOk || motion_ == nullptr || report_.deskewed_frames() > 0) return concluded;
    return refuse(kInputRefused,
                  fmt::format("{}: none of the {} frames could be deskewed; is it of "
                              "this drive, its stamps on the clock of the capture's?",
                              options_.can_recording.string(), report_.records.size()));
  }

  const Options& options_;
  OpenCapture& capture_;
  RecordedMotion* motion_;
  memory::FixedMemory memory_;
  run::PacketPipeline pipeline_;
  hdl64e::StatusStreamReader status_;
  DeviceClock clock_of_device_;
  FrameOutputs outputs_;
  std::unique_ptr<ground::NearGround> near_ground_ = std::make_unique<ground::NearGround>();
  mount::Mount sensor_mount_;
  MountWatch mount_;
  FrameTruth truth_;
  Report report_;
  Progress progress_;
  Status sinks_;
  std::uint64_t offered_ = 0;  ///< Datagrams given to the decoder.
};

}  // namespace

ExitCode run_replay(const Options& options) {
  const bool from_the_start = options.capture.start_s == 0 && options.replay.loops == 1;
  if (!options.output.truth.empty() && !from_the_start) {
    return refuse(kUsage,
                  "--truth goes by frame number, so the replay must run once from the capture's "
                  "beginning: leave --start and --loop away");
  }
  if (!options.output.truth.empty() && !std::filesystem::is_directory(options.output.truth)) {
    return refuse(kInputRefused, fmt::format("--truth {}: no such folder; expected one of "
                                             "NNNNNN.label, as `terracut simulate` writes it",
                                             options.output.truth.string()));
  }
  auto capture = open_capture(options.capture);
  if (!capture) return refuse(capture.error());
  CaptureFrames frames(*capture, options);
  const auto mount = choose_mount(options.mount, frames);
  if (!mount) return refuse_work(mount.error());
  const auto profile = ring_profile_of(capture->calibration, mount->options);
  if (!profile) return refuse(profile.error());
  memory::FixedMemory motion_memory;
  std::optional<RecordedMotion> motion;
  if (!options.can_recording.empty()) {
    auto opened = RecordedMotion::open(options, motion_memory);
    if (!opened) return refuse(opened.error());
    motion.emplace(*std::move(opened));
  }
  catch_stop_signals();
  return Replay(options, *capture, *profile, *mount, motion ? &*motion : nullptr).run();
}

}  // namespace terracut::cli
