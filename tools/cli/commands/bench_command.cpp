// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "pipeline/run/packet_pipeline.hpp"
#include "pipeline/status/figure_lines.hpp"
#include "pipeline/status/times_table.hpp"
#include "rt/measure/milliseconds.hpp"
#include "rt/threads/thread_setup.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/figures/figures_json.hpp"
#include "tools/cli/figures/run_report.hpp"
#include "tools/cli/input/mount_choice.hpp"
#include "tools/cli/input/open_capture.hpp"
#include "tools/cli/input/recorded_frames.hpp"
#include "tools/cli/json_text.hpp"
#include "tools/cli/settings/decoder_choice.hpp"
#include "tools/cli/settings/setup_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

using measure::milliseconds;

/// Keeps this thread on one core; -1 means the last one allowed. Returns the core, or -1 if the
/// system refuses.
int stay_on_core(int core) {
  const std::vector<int> allowed = threads::allowed_cores();
  if (core < 0 && !allowed.empty()) core = allowed.back();
  if (core < 0) return -1;
  const auto grants = threads::set_up_this_thread({.name = "terracut", .core = core});
  return grants && threads::all_granted(*grants) ? core : -1;
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

/// Datagrams in memory, so that reading a file does not disturb the measurement.
struct Packets {
  std::vector<std::uint8_t> payloads;
  std::vector<packet::Datagram> datagrams;
};

Expected<Packets> load(CapturePart& part) {
  Packets packets;
  while (const packet::Datagram* datagram = part.next()) {
    packets.datagrams.push_back(*datagram);
    packets.payloads.insert(packets.payloads.end(), datagram->payload.begin(),
                            datagram->payload.end());
  }
  if (const Status whole = go_on(); !whole) return tl::unexpected(whole.error());
  part.warn_of_oddities();
  std::span<const std::uint8_t> rest(packets.payloads);
  for (packet::Datagram& datagram : packets.datagrams) {
    datagram.payload = rest.first(datagram.payload.size());
    rest = rest.subspan(datagram.payload.size());
  }
  return packets;
}

struct BenchResult {
  TimeSummary times;                             ///< Over all frames.
  measure::LogLinearHistogram decode_column_ns;  ///< The mean of each pass.
  std::uint64_t returns = 0, unlabelled = 0;
  std::vector<status::FrameRecord> each;  ///< In the order of passes and frames.
};

/// Runs one pass over the packets: decoding and labelling, timed frame by frame.
void run_frames(run::PacketPipeline& pipeline, const Packets& packets, BenchResult* result) {
  const auto take_frames = [&] {
    while (run::Frame* frame = pipeline.next()) {
      const status::FrameRecord& record = frame->record;
      if (result == nullptr || !record.info.complete) continue;
      result->times.add(record);
      result->each.push_back(record);
      result->returns += record.info.returns;
      result->unlabelled += record.info.returns - record.segmentation.labelled();
    }
  };
  for (const packet::Datagram& datagram : packets.datagrams) {
    pipeline.push(datagram);
    take_frames();
  }
  pipeline.end_stream();
  take_frames();
}

/// Runs one pass of decoding only. Returns nanoseconds per column of 64 lasers.
double run_decoding(decode::Decoder& decoder, const Packets& packets) {
  const std::uint64_t columns_before = decoder.columns_decoded();
  const std::int64_t start_ns = measure::thread_cpu_ns();
  for (const packet::Datagram& datagram : packets.datagrams) {
    decoder.push(datagram);
    while (decoder.next() != nullptr) {
    }
  }
  const std::int64_t spent_ns = measure::thread_cpu_ns() - start_ns;
  const std::uint64_t columns = decoder.columns_decoded() - columns_before;
  decoder.end_stream();
  while (decoder.next() != nullptr) {
  }
  return columns == 0 ? 0 : static_cast<double>(spent_ns) / static_cast<double>(columns);
}

/// Returns the data from which the summary is made: [{"decode", "segment", "after_frame"}, ..].
nlohmann::ordered_json frames_json(const std::vector<status::FrameRecord>& frames) {
  auto list = nlohmann::ordered_json::array();
  for (const status::FrameRecord& frame : frames) {
    list.push_back({{"decode", milliseconds(frame.decode_cpu_ns)},
                    {"segment", milliseconds(frame.stages.sum_ns())},
                    {"after_frame", milliseconds(frame.after_frame_cpu_ns())}});
  }
  return list;
}

/// Returns the figures, which refer to `result`.
std::vector<status::Figure> figures_of(const Options& options, const CapturePart& part,
                                       const BenchResult& result, int core) {
  const double returns_per_frame =
      static_cast<double>(result.returns) / static_cast<double>(result.each.size());
  const auto column_ns = [&](double percent) {
    return static_cast<std::uint64_t>(result.decode_column_ns.percentile_ns(percent));
  };
  // clang-format off: a table reads better with an entry on two lines than one word a line.
  std::vector<status::Figure> figures{
      {"terracut", TERRACUT_VERSION},
      {"command", "bench"},
      {"input", options.capture.file.string()},
      {"processor", processor_name(), {}, {"processor"}},
      {{}, core < 0 ? "not pinned" : fmt::format("core {}", core), {}, {"processor"}},
      {"frames", result.each.size(), {}, {"frames"}},
      {{}, static_cast<std::uint64_t>(options.bench_repeat), {}, {"frames", " ({} passes)"}},
      {"returns_per_frame",
       status::Number{returns_per_frame, 0, 1e9},
       {},
       {"frames", "{:.0f} returns each"}},
      {"returns_unlabelled", result.unlabelled},
      {{}, column_ns(50), {}, {"decode", "{} ns a packet column, p50 of the passes"}},
      {"p50", column_ns(50), {}, {}, "decode_ns_per_column"},
      {"p99", column_ns(99), {}, {}, "decode_ns_per_column"},
      {"max", column_ns(100), {}, {}, "decode_ns_per_column"}};
  // clang-format on
  std::ranges::copy(outside_figures(part.before_start(), part.behind_end()),
                    std::back_inserter(figures));
  std::ranges::copy(method_figures(options.method), std::back_inserter(figures));
  std::ranges::copy(result.times.figures(), std::back_inserter(figures));
  return figures;
}

ExitCode conclude(const Options& options, const CapturePart& part, const BenchResult& result,
                  int core) {
  const auto figures = figures_of(options, part, result, core);
  print_out("{}{}", figure_lines(figures, {}), times_table(figures, {}));
  nlohmann::ordered_json json;
  add_figures(figures, json);
  json["core"] = core;
  json["frames_ms"] = frames_json(result.each);
  return done_or_refused(write_json(options.output.json, json));
}

}  // namespace

ExitCode run_bench(const Options& options) {
  catch_stop_signals();
  auto capture = open_capture(options.capture);
  if (!capture) return refuse(capture.error());
  say_what_is_read(*capture);
  CaptureFrames frames(*capture, options);
  const auto mount = choose_mount(guessing(options.mount), frames);
  if (!mount) return refuse_work(mount.error());
  const auto profile = ring_profile_of(capture->calibration, mount->options);
  if (!profile) return refuse(profile.error());
  CapturePart part(capture->source, options.capture);
  const auto packets = load(part);
  if (!packets) return refuse_work(packets.error());

  warn_of_other_senders(*capture, capture->source.counters(), options.capture);
  memory::FixedMemory memory;
  const auto decoder_config = decoder_config_of(options, capture->sensor.columns);
  run::PacketPipeline pipeline(
      capture->calibration, *profile, decoder_config, turn_method_of(options.method), memory,
      run::PacketPipeline::Makes::kLabels, run::PacketPipeline::Timing::kFrames);
  decode::Decoder decoder(capture->calibration, profile->mount, decoder_config, memory);
  const int core = stay_on_core(options.bench_core);
  if (core < 0) warn("could not stay on one core; times include moves between cores");

  run_frames(pipeline, *packets, nullptr);  // warms caches and branch predictors; not counted
  BenchResult result;
  Progress progress("measuring", "passes", options.bench_repeat);
  for (int pass = 0; pass < options.bench_repeat; ++pass) {
    if (const Status status = go_on(); !status) return refuse_work(status.error());
    run_frames(pipeline, *packets, &result);
    result.decode_column_ns.record(static_cast<std::int64_t>(run_decoding(decoder, *packets)));
    progress.update(pass + 1);
  }
  if (result.each.empty()) {
    return refuse(
        nothing_came_out(capture->source, part, packets->datagrams.size(), pipeline.decoder()));
  }
  return conclude(options, part, result, core);
}

}  // namespace terracut::cli
