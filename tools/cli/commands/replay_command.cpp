// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/commands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <thread>
#include <utility>

#include "pipeline/visibility/sight_news.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/figures/run_report.hpp"
#include "tools/cli/input/frame_truth.hpp"
#include "tools/cli/input/labelled_capture.hpp"
#include "tools/cli/output/frame_outputs.hpp"
#include "tools/cli/settings/setup_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

using frame::FrameInfo;

/// Sleeps so that datagrams come at `rate` times the capture's speed; with rate 0 it never sleeps.
/// A sleep ends soon if the run is to stop. Pauses longer than kLongestPause_ns are skipped: they
/// mean that the capture's clock was set.
class Pace {
 public:
  explicit Pace(double rate) : rate_(rate) {}

  void restart() noexcept { begun_ = false; }
  void wait_for(std::int64_t since_begin_ns) {
    if (rate_ <= 0) return;
    const auto now = std::chrono::steady_clock::now();
    if (!begun_ || since_begin_ns - newest_ns_ > kLongestPause_ns) {
      begun_ = true;
      first_ns_ = since_begin_ns;
      started_ = now;
    }
    newest_ns_ = since_begin_ns;
    constexpr double kFar_ns = 9e18;  // a rate near 0 would overflow 64 bits
    const double due_ns = static_cast<double>(since_begin_ns - first_ns_) / rate_;
    const auto due = started_ + std::chrono::nanoseconds(
                                    static_cast<std::int64_t>(std::clamp(due_ns, 0.0, kFar_ns)));
    constexpr std::chrono::milliseconds kMoment{100};
    for (auto at = now; at < due && !stop_wanted(); at = std::chrono::steady_clock::now()) {
      std::this_thread::sleep_until(std::min(due, at + kMoment));
    }
  }

 private:
  static constexpr std::int64_t kLongestPause_ns = 60'000'000'000;

  double rate_;
  bool begun_ = false;
  std::int64_t first_ns_ = 0, newest_ns_ = 0;
  std::chrono::steady_clock::time_point started_;
};

/// Hands the labelled frames of a capture to the sinks named by the options.
class Replay {
 public:
  Replay(const Options& options, LabelledCapture& capture, FrameTruth truth)
      : options_(options),
        capture_(capture),
        outputs_(options.output),
        truth_(std::move(truth)),
        pace_(options.replay.rate),
        progress_("replaying", "frames", 0) {
    capture.before_each(
        [this](std::int64_t stamp_ns) { pace_.wait_for(capture_.since_begin_ns(stamp_ns)); });
  }

  ExitCode run() {
    sinks_ = outputs_.open({.sensor = capture_.capture().sensor_line,
                            .rows = capture_.decoder().shape().rows,
                            .mount = capture_.sensor_mount(),
                            .has_road = method_config_of(options_.method).segmenter.road.enabled,
                            .found = options_.method.scene});
    if (!sinks_) return refuse(sinks_.error());
    if (options_.method.scene.any()) {
      outputs_.find_scene(options_.method.scene, capture_.profile(), capture_.decoder().shape(),
                          capture_.decoder().return_capacity());
    }
    Report& report = capture_.report();
    for (int pass = 0; options_.replay.loops == 0 || pass < options_.replay.loops; ++pass) {
      if (pass > 0) {
        if (Status status = capture_.rewind(); !status) return refuse(status.error());
      }
      pace_.restart();
      const std::uint64_t offered_before = capture_.offered();
      while (const run::Frame* frame = sinks_ ? capture_.next() : nullptr) take(*frame);
      const bool is_over = report.interrupted || !report.input_warning.empty();
      // An endless replay normally ends by Ctrl-C, so it does not count as interrupted.
      if (options_.replay.loops == 0) report.interrupted = false;
      // If this pass had no packets, later passes have none either.
      if (!sinks_ || is_over || capture_.offered() == offered_before) break;
    }
    return conclude();
  }

 private:
  /// Hands on a frame. The first error of an output is kept and ends the replay.
  void take(const run::Frame& frame) {
    const FrameInfo& info = frame.record.info;
    const std::span<const frame::Label> labels = capture_.labels();
    const std::string name = fmt::format("{:06}", info.number);
    const std::span<const std::uint32_t> truth = truth_of(name, info.returns);
    if (!truth.empty()) capture_.report().score(labels, truth);
    if (frame.image != nullptr) {
      outputs_.look(*frame.image, *frame.as_measured, labels, capture_.heights_m(),
                    visibility::SightWatch::is_whole(info, frame.image->shape()));
      if (options_.method.scene.sight) note_sight(info);
    }
    sinks_ = outputs_.write_labels(name, labels, outputs_.object_of_return());
    if (sinks_ && frame.image != nullptr) sinks_ = write_points(name, frame, truth);
    progress_.update(static_cast<double>(capture_.report().totals.frames));
  }

  /// Returns the true class of each return. Empty if no truth was asked for or the frame's file
  /// does not fit, which is reported once.
  std::span<const std::uint32_t> truth_of(const std::string& name, std::size_t returns) {
    const Status read = truth_.read(name, returns);
    if (!read && !std::exchange(warned_, true)) {
      warn("frames without fitting truth are not scored; the first: " + read.error().message);
    }
    return truth_.labels();
  }

  /// Keeps how far the sensor sees for the report, and prints what changes.
  void note_sight(const FrameInfo& info) {
    visibility::SightFigures& sight = capture_.report().sight;
    sight = outputs_.sight();
    const auto news = sight_news_.look(sight, info.last_packet_ns);
    if (!news.text.empty()) say(fmt::format("frame {}: {}", info.number, news.text));
  }

  [[nodiscard]] Status write_points(const std::string& name, const run::Frame& frame,
                                    std::span<const std::uint32_t> truth) {
    const auto labels = capture_.labels();
    const auto heights_m = capture_.heights_m();
    const Status written = outputs_.write_frame(name, *frame.image, labels, heights_m, truth);
    if (!written) return written;
    return outputs_.publish(frame.record, *frame.image, labels, heights_m, capture_.timing(frame));
  }

  ExitCode conclude() {
    if (sinks_) sinks_ = outputs_.finish();
    if (!sinks_) return refuse(sinks_.error());
    if (capture_.report().totals.frames == 0 && capture_.report().interrupted) {
      return refuse(kInterrupted, "interrupted before the first frame came out");
    }
    const Status concluded = capture_.conclude();
    if (!concluded && capture_.report().totals.frames == 0) return refuse(concluded.error());
    const ExitCode written = conclude_with(capture_.report(), options_.output.json);
    return concluded || written != kOk ? written : refuse(concluded.error());
  }

  const Options& options_;
  LabelledCapture& capture_;
  FrameOutputs outputs_;
  FrameTruth truth_;
  bool warned_ = false;  ///< Of a frame without fitting truth.
  visibility::SightNews sight_news_;
  Pace pace_;
  Progress progress_;
  Status sinks_;
};

}  // namespace

ExitCode run_replay(const Options& options) {
  const bool from_the_start = options.capture.start_s == 0 && options.replay.loops == 1;
  if (!options.output.truth.empty() && !from_the_start) {
    return refuse(kUsage,
                  "--truth goes by frame number, so the replay must run once from the capture's "
                  "beginning: leave --start and --loop away");
  }
  auto truth = FrameTruth::open(options.output.truth);
  if (!truth) return refuse(truth.error());
  auto capture = LabelledCapture::open(
      options, FrameOutputs::need_points(options.output) || options.method.scene.any()
                   ? LabelledCapture::Makes::kPoints
                   : LabelledCapture::Makes::kLabels);
  if (!capture) return refuse_work(capture.error());
  catch_stop_signals();
  return Replay(options, **capture, *std::move(truth)).run();
}

}  // namespace terracut::cli
