// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "figures_json.hpp"
#include "pipeline/status/figure_lines.hpp"
#include "pipeline/status/figures.hpp"
#include "pipeline/status/loss_causes.hpp"
#include "pipeline/status/times_table.hpp"
#include "rt/files/whole_file.hpp"
#include "rt/measure/milliseconds.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/json_text.hpp"

namespace terracut::cli {
namespace {

using Json = nlohmann::ordered_json;

using measure::milliseconds;
using status::Figure;
using status::FrameRecord;
using status::Shown;

Json losses_json(const frame::LossCounters& losses) {
  Json json = Json::object();
  for (const status::NamedCount& cause : status::causes_of(losses)) {
    json[std::string(cause.name.view())] = cause.count;
  }
  return json;
}

Json milliseconds_json(const FrameRecord& frame) {
  Json json;
  json["decode"] = milliseconds(frame.decode_cpu_ns);
  for (std::size_t i = 0; i < frame.stages.stage_ns.size(); ++i) {
    json[std::string(to_string(static_cast<stage::Stage>(i)))] =
        milliseconds(frame.stages.stage_ns[i]);
  }
  json["total"] = milliseconds(frame.decode_cpu_ns + frame.stages.sum_ns());
  json["after_frame"] = milliseconds(frame.after_frame_cpu_ns());
  return json;
}

/// How many cells the cut had to decide, how many kept their coarse label for want of budget, and
/// the operations it took.
Json min_cut_json(const min_cut::CutReport& cut) {
  return {{"unknown", cut.unknown},
          {"coarse", cut.coarse_by_cap + cut.coarse_by_budget},
          {"ops", cut.operations()}};
}

/// How the vehicle's motion and the frames fit together in time.
std::vector<Figure> motion_figures(std::uint64_t samples, const std::vector<FrameRecord>& records) {
  std::uint64_t deskewed = 0;
  std::vector<std::int64_t> newest_ns;
  for (const FrameRecord& frame : records) {
    deskewed += frame.info.deskew.state == frame::DeskewState::kDone ? 1 : 0;
    newest_ns.push_back(frame.info.deskew.newest_motion_ns);
  }
  if (newest_ns.empty()) newest_ns.push_back(0);
  std::ranges::sort(newest_ns);
  const std::string_view line = samples > 0 ? "motion" : "";
  const auto of = [](std::string_view key, std::int64_t ns, const status::Phrase& phrase) {
    return Figure{key, status::Duration{ns}, {}, phrase, "motion.newest_sample_after_frame_ms"};
  };
  // clang-format off: a table reads better with an entry on two lines than one word a line.
  return {{"samples", samples, {}, {"motion", "{} samples"}, "motion"},
          {"deskewed_frames", deskewed, {}, {"motion", ": {} frames deskewed"}, "motion"},
          {{}, records.size() - deskewed, {}, {"motion", "{} without ego motion"}},
          of("median", newest_ns[newest_ns.size() / 2],
             {line, "newest sample {ms:+.1f} ms from a frame's end (median"}),
          of("min", newest_ns.front(), {line, ": {ms:+.1f}"}),
          of("max", newest_ns.back(), {line, " to {ms:+.1f})"})};
  // clang-format on
}

}  // namespace

void TimeSummary::add(const FrameRecord& frame) noexcept {
  for (std::size_t i = 0; i < stages.size(); ++i) stages[i].record(frame.stages.stage_ns[i]);
  decode.record(frame.decode_cpu_ns);
  total.record(frame.decode_cpu_ns + frame.stages.sum_ns());
  after_frame.record(frame.after_frame_cpu_ns());
  wall.record(frame.stages.segment_wall_ns);
}

std::vector<Figure> TimeSummary::figures() const {
  std::vector<Figure> figures;
  const auto add = [&](std::string_view name, const measure::LogLinearHistogram& times) {
    figures.push_back({name, &times, {}, {"times", name, Shown::kIfAny}, "ms"});
  };
  add("decode", decode);
  for (std::size_t i = 0; i < stages.size(); ++i) {
    add(to_string(static_cast<stage::Stage>(i)), stages[i]);
  }
  add("total", total);
  add("after_frame", after_frame);
  return figures;
}

void Report::add(const FrameRecord& frame) {
  records_.push_back(frame);
  times_.add(frame);
}

frame::LossCounters Report::losses() const {
  if (losses_) return *losses_;
  frame::LossCounters losses;
  for (const FrameRecord& frame : records_) losses += frame.info.losses;
  return losses;
}

// clang-format off: a table reads better with an entry on two lines than one word a line.

std::vector<Figure> Report::run_figures() const {
  std::vector<Figure> figures{{"terracut", TERRACUT_VERSION},
                              {"command", run_.command},
                              {"input", run_.input},
                              {"interrupted", interrupted_},
                              {"calibration", run_.calibration}};
  const auto add_any = [&](std::string_view key, const std::string& text, std::string_view line) {
    if (!text.empty()) figures.push_back({key, text, {}, {line}});
  };
  add_any("input_warning", input_warning_, {});
  add_any("sensor", run_.sensor, "sensor");
  add_any({}, run_.calibration, "table");
  add_any("device_clock", device_clock_, "clock");
  add_any("method", run_.method, {});
  if (run_.method.empty()) {
    figures.push_back({"profile", run_.profile});
    figures.push_back({"stages", run_.stages});
  }
  return figures;
}

std::vector<Figure> Report::summary_figures() const {
  std::uint64_t complete = 0, returns_in = 0, returns_labelled = 0;
  for (const FrameRecord& frame : records_) {
    complete += frame.info.complete ? 1 : 0;
    returns_in += frame.info.returns;
    returns_labelled += frame.segmentation.labelled();
  }
  std::vector<Figure> figures{
      {"frames", records_.size(), {}, {"frames"}},
      {"complete_frames", complete, {}, {"frames", " ({} complete)"}},
      {"returns_in", returns_in, {}, {"returns", "{} in"}},
      {"returns_labelled", returns_labelled, {}, {"returns", "{} labelled"}},
      {"segment_wall_ms", &times_.wall}};
  const auto add = [&](std::initializer_list<Figure> more) { figures.insert(figures.end(), more); };
  std::ranges::copy(times_.figures(), std::back_inserter(figures));
  if (scan_points_) {
    add({{"points_no_place",
          scan_points_->no_place,
          {},
          {"returns", "{} points null or not finite, labelled 0", Shown::kIfAny}},
         {"points_no_ring",
          scan_points_->no_ring,
          {},
          {"returns", "{} points of no ring, labelled obstacle", Shown::kIfAny}}});
  }
  if (quality_) {
    const double iou_g = quality_->iou_ground(), recall_o = quality_->recall_key_obstacles();
    add({{"iou_g", status::Number{iou_g, 0, 1}},
         {"recall_o", status::Number{recall_o, 0, 1}},
         {{}, status::Number{100 * iou_g, 0, 100}, {}, {"quality", "IoU_g {:.2f} %"}},
         {{}, status::Number{100 * recall_o, 0, 100}, {}, {"quality", "Recall_o {:.2f} %"}},
         {"unscored_frames",
          unscored_,
          {},
          {"quality", " ({} frames not scored)", Shown::kIfAny}}});
  }
  std::ranges::copy(status::figures_of(mount_), std::back_inserter(figures));
  std::ranges::copy(status::figures_of(blind_), std::back_inserter(figures));
  if (motion_samples_) {
    std::ranges::copy(motion_figures(*motion_samples_, records_), std::back_inserter(figures));
  }
  add({{"losses",
        status::counts_of("cause", status::causes_of(losses())),
        {},
        {"losses", "{}", Shown::kAlarmOrNone}},
       {{},
        interrupted_,
        {},
        {"ended", "interrupted: the rest of the input was not read", Shown::kAlarm}}});
  return figures;
}

// clang-format on

std::string Report::text() const {
  const auto summary = summary_figures();
  return figure_lines(run_figures(), {}) + figure_lines(summary, {}) + times_table(summary, {});
}

Status Report::write_json(const std::filesystem::path& path) const {
  Json json;
  add_figures(run_figures(), json);
  Json& frames = json["frames"] = Json::array();
  for (const FrameRecord& frame : records_) {
    frames.push_back({{"frame", frame.info.number},
                      {"first_packet_ns", frame.info.first_packet_ns},
                      {"complete", frame.info.complete},
                      {"returns_in", frame.info.returns},
                      {"returns_labelled", frame.segmentation.labelled()},
                      {"losses", losses_json(frame.info.losses)},
                      {"ms", milliseconds_json(frame)},
                      {"segment_wall_ms", milliseconds(frame.stages.segment_wall_ns)},
                      {"min_cut", min_cut_json(frame.segmentation.cut)}});
    if (motion_samples_) {
      frames.back()["deskewed"] = frame.info.deskew.state == frame::DeskewState::kDone;
    }
  }
  add_figures(summary_figures(), json["summary"]);
  return files::write_whole_file(path, json_text(json));
}

ExitCode conclude_with(const Report& report, const std::filesystem::path& json) {
  fmt::print("{}", report.text());
  if (!json.empty()) {
    const Status written = report.write_json(json);
    if (!written) return refuse(written.error());
  }
  return report.interrupted() ? kInterrupted : kOk;
}

}  // namespace terracut::cli
