// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/figures/run_report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "pipeline/status/figure_lines.hpp"
#include "pipeline/status/figures.hpp"
#include "pipeline/status/loss_causes.hpp"
#include "pipeline/status/times_table.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/figures/figures_json.hpp"
#include "tools/cli/json_text.hpp"
#include "tools/cli/settings/words.hpp"

namespace terracut::cli {
namespace {

using Json = nlohmann::ordered_json;

using status::Figure;
using status::FrameRecord;
using status::Shown;

bool is_deskewed(const FrameRecord& frame) {
  return frame.info.deskew.state == frame::DeskewState::kDone;
}

/// True for frames from packets. A cloud comes at once, so that no work is done while it arrives.
bool arrived_in_packets(const FrameRecord& frame) {
  return frame.decode_cpu_ns > 0;
}

/// Returns the figures that the report states for every frame. For its min-cut these are: the cells
/// to decide, the cells that the budget left to the coarse stages, and the operations.
std::vector<Figure> frame_figures(const FrameRecord& frame) {
  const min_cut::CutReport& cut = frame.segmentation.cut;
  const auto count = [](std::uint64_t of) { return status::Value(of); };
  std::vector<Figure> figures{
      {"frame", count(frame.info.number)},
      {"first_packet_ns", status::TimeOfDay{frame.info.first_packet_ns}},
      {"complete", frame.info.complete},
      {"returns_in", count(frame.info.returns)},
      {"returns_labelled", count(frame.segmentation.labelled())},
      {"returns_below", count(frame.segmentation.below)},
      {"losses", status::counts_of("cause", status::causes_of(frame.info.losses))}};
  const auto add_ms = [&](std::string_view key, std::int64_t ns) {
    figures.push_back({key, status::Duration{ns}, {}, {}, "ms"});
  };
  add_ms("decode", frame.decode_cpu_ns);
  for (std::size_t i = 0; i < frame.stages.stage_ns.size(); ++i) {
    add_ms(to_string(static_cast<stage::Stage>(i)), frame.stages.stage_ns[i]);
  }
  add_ms("total", frame.decode_cpu_ns + frame.stages.sum_ns());
  if (arrived_in_packets(frame)) add_ms("after_frame", frame.after_frame_cpu_ns());
  figures.insert(figures.end(),
                 {{"unknown", count(cut.unknown), {}, {}, "min_cut"},
                  {"coarse", count(cut.coarse_by_cap + cut.coarse_by_budget), {}, {}, "min_cut"},
                  {"ops", count(static_cast<std::uint64_t>(cut.operations())), {}, {}, "min_cut"}});
  return figures;
}

/// Returns the number of records of a capture by what became of them.
std::vector<Figure> datagram_figures(const capture::CaptureAccount& account) {
  std::vector<Figure> figures = outside_figures(account.before_start, account.behind_end);
  const auto add = [&](std::string_view key, std::uint64_t count) {
    figures.push_back({key, count, {}, {}, "datagrams"});
  };
  add("read", account.read.frames);
  add("decoded", account.decoded);
  add("device_info", account.device_info);
  add("rejected", account.losses.rejected_total());
  add("joined_fragments", account.read.joined);
  add("no_datagram", account.read.refused_total());
  add("other_port", account.read.other_port);
  add("other_source", account.read.other_source);
  add("other_stream", account.read.other_stream);
  return figures;
}

/// Returns how well the vehicle's motion and the frames match in time.
std::vector<Figure> motion_figures(std::uint64_t samples, const FrameTotals& totals) {
  const std::uint64_t deskewed = totals.deskewed;
  std::vector<std::int64_t> newest_ns = totals.newest_motion_ns;
  if (newest_ns.empty()) newest_ns.push_back(0);
  std::ranges::sort(newest_ns);
  const std::string_view line = samples > 0 ? "motion" : "";
  const auto of = [](std::string_view key, std::int64_t ns, const status::Phrase& phrase) {
    return Figure{key, status::Duration{ns}, {}, phrase, "motion.newest_sample_after_frame_ms"};
  };
  // clang-format off: a table reads better with an entry on two lines than one word a line.
  return {{"samples", samples, {}, {"motion", "{} samples"}, "motion"},
          {"deskewed_frames", deskewed, {}, {"motion", ": {} frames deskewed"}, "motion"},
          {{}, totals.frames - deskewed, {}, {"motion", "{} without ego motion"}},
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
  if (arrived_in_packets(frame)) after_frame.record(frame.after_frame_cpu_ns());
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
  if (after_frame.count() > 0) add("after_frame", after_frame);
  return figures;
}

std::vector<Figure> method_figures(const MethodOptions& options) {
  if (!options.method.empty()) return {{"method", options.method}};
  return {{"profile", std::string(word_of(kProfileWords, options.profile))},
          {"stages", std::string(word_of(kStageWords, options.last_stage))}};
}

std::vector<Figure> outside_figures(std::uint64_t before_start, std::uint64_t behind_end) {
  return {{"before_start",
           before_start,
           {},
           {"left out", "{} datagrams before --start", Shown::kIfAny},
           "datagrams"},
          {"behind_end",
           behind_end,
           {},
           {"left out", "{} datagrams behind --duration, and the rest unread", Shown::kIfAny},
           "datagrams"}};
}

void FrameTotals::add(const FrameRecord& frame, bool has_motion) {
  ++frames;
  complete += frame.info.complete ? 1 : 0;
  returns_in += frame.info.returns;
  returns_labelled += frame.segmentation.labelled();
  returns_below += frame.segmentation.below;
  losses += frame.info.losses;
  deskewed += is_deskewed(frame) ? 1 : 0;
  if (has_motion) newest_motion_ns.push_back(frame.info.deskew.newest_motion_ns);
}

void Report::add(const FrameRecord& frame) {
  totals.add(frame, motion_samples.has_value());
  times.add(frame);
  if (!entries) return;
  Json entry = frame_json(frame);
  if (motion_samples) entry["deskewed"] = is_deskewed(frame);
  entries->add(entry);
}

void Report::score(std::span<const frame::Label> labels, std::span<const std::uint32_t> truth) {
  scores += quality::measure(labels, truth);
  ++scored;
}

// clang-format off: a table reads better with an entry on two lines than one word a line.

std::vector<Figure> Report::run_figures() const {
  std::vector<Figure> figures{{"terracut", TERRACUT_VERSION},
                              {"command", command},
                              {"input", input},
                              {"interrupted", interrupted},
                              {"calibration", calibration}};
  const auto add_any = [&](std::string_view key, const std::string& text, std::string_view line) {
    if (!text.empty()) figures.push_back({key, text, {}, {line}});
  };
  add_any("sensor_warning", sensor_warning, {});
  add_any("input_warning", input_warning, {});
  add_any("sensor", sensor, "sensor");
  add_any({}, calibration, "table");
  add_any("device_clock", device_clock, "clock");
  std::ranges::copy(method_figures(method), std::back_inserter(figures));
  return figures;
}

std::vector<Figure> Report::summary_figures() const {
  std::vector<Figure> figures{
      {"frames", totals.frames, {}, {"frames"}},
      {"complete_frames", totals.complete, {}, {"frames", " ({} complete)"}},
      {"returns_in", totals.returns_in, {}, {"returns", "{} in"}},
      {"returns_labelled", totals.returns_labelled, {}, {"returns", "{} labelled"}},
      {"returns_below", totals.returns_below, {}, {"returns", "{} below the ground", Shown::kIfAny}}};
  const auto add = [&](std::initializer_list<Figure> more) { figures.insert(figures.end(), more); };
  std::ranges::copy(times.figures(), std::back_inserter(figures));
  if (scan_points) {
    add({{"points_no_place",
          scan_points->no_place,
          {},
          {"returns", "{} points null or not finite, labelled 0", Shown::kIfAny}},
         {"points_no_ring",
          scan_points->no_ring,
          {},
          {"returns", "{} points of no ring, labelled obstacle", Shown::kIfAny}}});
  }
  if (scored > 0) {
    const double iou_g = scores.iou_ground(), recall_o = scores.recall_key_obstacles();
    add({{"iou_g", status::Number{iou_g, 0, 1}},
         {"recall_o", status::Number{recall_o, 0, 1}},
         {{}, status::Number{100 * iou_g, 0, 100}, {}, {"quality", "IoU_g {:.2f} %"}},
         {{}, status::Number{100 * recall_o, 0, 100}, {}, {"quality", "Recall_o {:.2f} %"}},
         {"unscored_frames",
          totals.frames - scored,
          {},
          {"quality", " ({} frames not scored)", Shown::kIfAny}}});
  }
  std::ranges::copy(status::figures_of(mount), std::back_inserter(figures));
  std::ranges::copy(status::figures_of(blind), std::back_inserter(figures));
  std::ranges::copy(status::figures_of(sight), std::back_inserter(figures));
  if (motion_samples) {
    std::ranges::copy(motion_figures(*motion_samples, totals), std::back_inserter(figures));
  }
  if (datagrams) std::ranges::copy(datagram_figures(*datagrams), std::back_inserter(figures));
  add({{"losses",
        status::counts_of("cause", status::causes_of(losses.value_or(totals.losses))),
        {},
        {"losses", "{}", Shown::kAlarmOrNone}},
       {{},
        interrupted,
        {},
        {"ended", "interrupted: the rest of the input was not read", Shown::kAlarm}}});
  return figures;
}

// clang-format on

std::string Report::text() const {
  const auto summary = summary_figures();
  return figure_lines(run_figures(), {}) + figure_lines(summary, {}) + times_table(summary, {});
}

nlohmann::ordered_json frame_json(const FrameRecord& frame) {
  Json json;
  add_figures(frame_figures(frame), json);
  return json;
}

Json Report::json() const {
  Json json;
  add_figures(run_figures(), json);
  json["frames"] = Json::array();
  add_figures(summary_figures(), json["summary"]);
  return json;
}

Status Report::write_json(const std::filesystem::path& path) {
  return entries ? entries->write(path, json()) : cli::write_json(path, json());
}

ExitCode conclude_with(Report& report, const std::filesystem::path& json) {
  print_text(report.text());
  const ExitCode written = json.empty() ? kOk : done_or_refused(report.write_json(json));
  return written == kOk && report.interrupted ? kInterrupted : written;
}

}  // namespace terracut::cli
