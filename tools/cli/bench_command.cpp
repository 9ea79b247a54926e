// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands.hpp"
#include "console.hpp"
#include "open_capture.hpp"
#include "packet_chain.hpp"
#include "packet_store.hpp"
#include "report.hpp"
#include "rt/thread_setup.hpp"
#include "rt/whole_file.hpp"
#include "stop_signal.hpp"

namespace terracut::cli {
namespace {

using firmware_io::FrameInfo;
using Chain = PacketChainOf<pipeline::GroundMethod>;

/// Keeps this thread on one core; -1 means the last one it may use. Answers the core, or -1 when
/// the system does not allow it.
int stay_on_core(int core) {
  const std::vector<int> allowed = rt::allowed_cores();
  if (core < 0 && !allowed.empty()) core = allowed.back();
  if (core < 0) return -1;
  const auto grants = rt::set_up_this_thread({.name = "terracut", .core = core});
  return grants && rt::all_granted(*grants) ? core : -1;
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

Expected<PacketStore> load(OpenCapture& capture, const CaptureOptions& options) {
  PacketStore packets;
  CaptureWindow window(options);
  while (true) {
    if (const Status status = go_on(); !status) return tl::unexpected(status.error());
    const auto next = capture.source.next();
    if (!next) {
      warn(next.error().message);
      return packets;
    }
    if (!*next) return packets;
    const CaptureWindow::Place place = window.place((*next)->stamp_ns);
    if (place == CaptureWindow::Place::kAfter) return packets;
    if (place == CaptureWindow::Place::kInside) packets.add(**next);
  }
}

struct BenchResult {
  TimeSummary times;                        ///< Of whole frames.
  rt::LogLinearHistogram decode_column_ns;  ///< Mean of each pass.
  std::uint64_t frames = 0, returns = 0, unlabelled = 0;
  std::vector<FrameRecord> each;  ///< In order, pass after pass.
};

/// One pass over the packets: decoding and segmenting, timed frame by frame.
void run_frames(Chain& chain, const PacketStore& packets, BenchResult* result) {
  StageClock clock;
  std::int64_t resumed_ns = rt::thread_cpu_ns();
  const auto on_frame = [&](const FrameInfo& info, const pipeline::RangeImage& image) noexcept {
    const std::int64_t ahead_ns = clock.times().sum_ns();
    const std::int64_t decode_ns = rt::thread_cpu_ns() - resumed_ns - ahead_ns;
    const pipeline::SegmentationReport segmented = chain.segmenter.segment(image, &clock);
    const StageTimes times = clock.take();
    if (result != nullptr && info.complete) {
      const FrameRecord record = record_of(info, segmented, decode_ns, times, ahead_ns);
      result->times.add(record);
      result->each.push_back(record);
      ++result->frames;
      result->returns += record.returns_in;
      result->unlabelled += record.returns_in - record.returns_labelled;
    }
    resumed_ns = rt::thread_cpu_ns();
  };
  for (std::size_t i = 0; i < packets.size(); ++i) chain.decode(packets.at(i), on_frame, &clock);
  chain.decoder.flush(on_frame);
}

/// One pass of decoding alone: nanoseconds a column of 64 lasers.
double run_decoding(Chain& chain, const PacketStore& packets) {
  const auto nothing = [](const FrameInfo&, const pipeline::RangeImage&) noexcept {};
  const std::uint64_t columns_before = chain.decoder.columns_decoded();
  const std::int64_t start_ns = rt::thread_cpu_ns();
  for (std::size_t i = 0; i < packets.size(); ++i) chain.decoder.decode(packets.at(i), nothing);
  const std::int64_t spent_ns = rt::thread_cpu_ns() - start_ns;
  chain.decoder.flush(nothing);
  const std::uint64_t columns = chain.decoder.columns_decoded() - columns_before;
  return columns == 0 ? 0 : static_cast<double>(spent_ns) / static_cast<double>(columns);
}

/// [{"decode", "segment", "after_turn"}, ..]: what the summary is made of.
nlohmann::ordered_json frames_json(const std::vector<FrameRecord>& frames) {
  auto list = nlohmann::ordered_json::array();
  for (const FrameRecord& frame : frames) {
    list.push_back({{"decode", static_cast<double>(frame.decode_ns) / 1e6},
                    {"segment", static_cast<double>(frame.times.sum_ns()) / 1e6},
                    {"after_turn", static_cast<double>(after_turn_ns(frame)) / 1e6}});
  }
  return list;
}

ExitCode print(const BenchOptions& options, const BenchResult& result, int core) {
  const double returns_per_frame =
      static_cast<double>(result.returns) / static_cast<double>(result.frames);
  fmt::print("processor {}, core {}\n", processor_name(),
             core < 0 ? "not pinned" : std::to_string(core));
  fmt::print("frames    {} ({} passes), {:.0f} returns each\n", result.frames, options.repeat,
             returns_per_frame);
  fmt::print("decode    {} ns a packet column, p50 of the passes\n",
             result.decode_column_ns.percentile_ns(50));
  fmt::print("{}", result.times.text());
  if (options.json.empty()) return kOk;

  nlohmann::ordered_json json;
  json["terracut"] = TERRACUT_VERSION;
  json["command"] = "bench";
  json["input"] = options.capture.file.string();
  json["processor"] = processor_name();
  json["core"] = core;
  if (options.method.method.empty()) {
    json["profile"] = options.method.profile;
    json["stages"] = options.method.stages;
  } else {
    json["method"] = options.method.method;
  }
  json["frames"] = result.frames;
  json["returns_per_frame"] = returns_per_frame;
  json["returns_unlabelled"] = result.unlabelled;
  json["decode_ns_per_column"] = {{"p50", result.decode_column_ns.percentile_ns(50)},
                                  {"p99", result.decode_column_ns.percentile_ns(99)},
                                  {"max", result.decode_column_ns.max_ns()}};
  json["ms"] = result.times.json();
  json["frames_ms"] = frames_json(result.each);
  const Status written = rt::write_whole_file(options.json, json.dump(1) + "\n");
  return written ? kOk : refuse(written.error());
}

}  // namespace

ExitCode run(const BenchOptions& options) {
  catch_stop_signals();
  auto capture = open_capture(options.capture);
  if (!capture) return refuse(capture.error());
  const auto profile = ring_profile_of(capture->calibration, options.mount);
  if (!profile) return refuse(profile.error());
  const auto packets = load(*capture, options.capture);
  if (!packets) return refuse_work(packets.error());

  warn_of_other_senders(*capture, options.capture);
  rt::FixedMemory memory;
  Chain chain(capture->calibration, *profile, capture->sensor.columns, options.capture,
              options.method, memory);
  const int core = stay_on_core(options.core);
  if (core < 0) warn("could not stay on one core; times include moves between cores");

  run_frames(chain, *packets, nullptr);  // warms caches and branch predictors; not counted
  const firmware_io::LossCounters first_pass_losses = chain.decoder.losses();
  BenchResult result;
  Progress progress("measuring", "passes", options.repeat);
  for (int pass = 0; pass < options.repeat; ++pass) {
    if (const Status status = go_on(); !status) return refuse_work(status.error());
    run_frames(chain, *packets, &result);
    result.decode_column_ns.record(static_cast<std::int64_t>(run_decoding(chain, *packets)));
    progress.update(pass + 1);
  }
  if (result.frames == 0) {
    return refuse(nothing_came_out(capture->source, packets->size(), first_pass_losses));
  }
  return print(options, result, core);
}

}  // namespace terracut::cli
