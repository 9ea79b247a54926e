// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "chrome_trace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "rt/measure/milliseconds.hpp"

namespace terracut::cli {
namespace {

using Json = nlohmann::ordered_json;
using measure::milliseconds;

enum Track : int { kReceive = 1, kSegment = 2 };
constexpr int kProcess = 1;

std::int64_t origin_of(std::span<const status::FrameRecord> frames) {
  std::int64_t origin_ns = INT64_MAX;
  for (const status::FrameRecord& frame : frames) {
    for (const std::int64_t stamp_ns : {frame.info.first_packet_ns, frame.info.last_packet_ns,
                                        frame.handed_over_ns, frame.labels_ns}) {
      if (stamp_ns > 0) origin_ns = std::min(origin_ns, stamp_ns);
    }
  }
  return origin_ns == INT64_MAX ? 0 : origin_ns;
}

class Trace {
 public:
  Trace(const status::MonitorSnapshot& figures, std::int64_t origin_ns)
      : figures_(figures), origin_ns_(origin_ns) {
    meta("process_name", 0, {{"name", "terracut live"}});
    track(kReceive, "receive");
    track(kSegment, "segment");
  }

  void add(const status::FrameRecord& frame) {
    add_receive(frame);
    add_segment(frame);
    if (frame.missed) add_miss(frame);
  }

  [[nodiscard]] Json take() && {
    Json json;
    json["displayTimeUnit"] = "ms";
    json["otherData"] = {{"terracut", figures_.version.view()},
                         {"sensor", figures_.sensor.view()},
                         {"origin_ns", origin_ns_}};
    json["traceEvents"] = std::move(events_);
    return json;
  }

 private:
  void add_receive(const status::FrameRecord& frame) {
    const std::int64_t first_ns =
        frame.info.first_packet_ns > 0 ? frame.info.first_packet_ns : frame.info.last_packet_ns;
    slice(kReceive, fmt::format("frame {}", frame.info.number),
          first_ns > 0 ? std::max(first_ns, handed_over_before_ns_) : 0, frame.handed_over_ns,
          {{"returns", frame.info.returns}, {"cpu_ms", milliseconds(frame.decode_cpu_ns)}});
    if (frame.handed_over_ns > 0) handed_over_before_ns_ = frame.handed_over_ns;
  }

  void add_segment(const status::FrameRecord& frame) {
    if (frame.level == status::Level::kSkipped) return;
    Json stages = Json::object();
    for (std::size_t i = 0; i < figures_.stages(); ++i) {
      stages[std::string(figures_.stage_names[i].view())] = milliseconds(frame.stages.stage_ns[i]);
    }
    slice(kSegment, fmt::format("frame {}", frame.info.number), frame.handed_over_ns,
          frame.labels_ns,
          {{"level", to_string(frame.level)},
           {"latency_ms", milliseconds(frame.labels_ns - frame.info.last_packet_ns)},
           {"cpu_ms", milliseconds(frame.segment_cpu_ns)},
           {"stages_cpu_ms", std::move(stages)},
           {"run_queue_wait_ms", milliseconds(frame.run_queue_wait_ns)},
           {"steal_ms", milliseconds(frame.steal_ns)},
           {"cut_operations", frame.segmentation.cut.operations()},
           {"motion", to_string(frame.info.deskew.state)}});
  }

  /// Marks the missed deadline of a labelled frame, or the time at which a skipped frame was given
  /// up.
  void add_miss(const status::FrameRecord& frame) {
    if (frame.labels_ns <= 0) return;
    const std::int64_t when_ns =
        frame.info.last_packet_ns > 0
            ? std::min(frame.labels_ns, frame.info.last_packet_ns + figures_.deadline_ns)
            : frame.labels_ns;
    Json event = event_of("i", kSegment, fmt::format("missed: {}", to_string(frame.cause)));
    event["ts"] = microseconds(when_ns);
    event["s"] = "p";
    event["args"] = {{"frame", frame.info.number}, {"level", to_string(frame.level)}};
    events_.push_back(std::move(event));
  }

  void slice(Track on, std::string name, std::int64_t begin_ns, std::int64_t end_ns, Json args) {
    if (begin_ns <= 0 || end_ns < begin_ns) return;  // an unknown stamp
    Json event = event_of("X", on, std::move(name));
    event["ts"] = microseconds(begin_ns);
    event["dur"] = static_cast<double>(end_ns - begin_ns) / 1000.0;
    event["args"] = std::move(args);
    events_.push_back(std::move(event));
  }

  void track(Track which, const char* name) {
    meta("thread_name", which, {{"name", name}});
    meta("thread_sort_index", which, {{"sort_index", static_cast<int>(which)}});
  }
  void meta(const char* what, int thread, Json args) {
    Json event = event_of("M", thread, what);
    event["args"] = std::move(args);
    events_.push_back(std::move(event));
  }
  [[nodiscard]] static Json event_of(const char* phase, int thread, std::string name) {
    return {{"name", std::move(name)}, {"ph", phase}, {"pid", kProcess}, {"tid", thread}};
  }
  [[nodiscard]] double microseconds(std::int64_t stamp_ns) const {
    return static_cast<double>(stamp_ns - origin_ns_) / 1000.0;
  }

  const status::MonitorSnapshot& figures_;
  std::int64_t origin_ns_;
  std::int64_t handed_over_before_ns_ = 0;
  Json events_ = Json::array();
};

}  // namespace

Json chrome_trace(const status::MonitorSnapshot& figures,
                  std::span<const status::FrameRecord> frames) {
  Trace trace(figures, origin_of(frames));
  for (const status::FrameRecord& frame : frames) trace.add(frame);
  return std::move(trace).take();
}

}  // namespace terracut::cli
