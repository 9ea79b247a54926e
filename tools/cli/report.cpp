// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "blind_text.hpp"
#include "console.hpp"
#include "loss_table.hpp"
#include "mount_text.hpp"
#include "rt/whole_file.hpp"

namespace terracut::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Milliseconds to the microsecond: more digits would only be noise.
double milliseconds(std::int64_t ns) {
  return static_cast<double>(ns / 1000) / 1000.0;
}

Json losses_json(const firmware_io::LossCounters& losses) {
  Json json = Json::object();
  for (const LossCause& cause : causes_of(losses)) json[cause.name] = cause.count;
  return json;
}

Json milliseconds_json(const FrameRecord& frame) {
  Json json;
  json["decode"] = milliseconds(frame.decode_ns);
  for (std::size_t i = 0; i < frame.times.stage_ns.size(); ++i) {
    json[std::string(to_string(static_cast<pipeline::Stage>(i)))] =
        milliseconds(frame.times.stage_ns[i]);
  }
  json["total"] = milliseconds(frame.decode_ns + frame.times.sum_ns());
  json["after_turn"] = milliseconds(after_turn_ns(frame));
  return json;
}

/// How many cells the cut had to decide, how many kept their coarse label for want of budget, and
/// the operations it took.
Json min_cut_json(const pipeline::CutReport& cut) {
  return {{"unknown", cut.unknown},
          {"coarse", cut.coarse_by_cap + cut.coarse_by_budget},
          {"ops", cut.persistency_ops + cut.greedy_push_ops + cut.boykov_kolmogorov_ops +
                      cut.push_relabel_ops}};
}

Json percentiles_json(const rt::LogLinearHistogram& histogram) {
  return {{"p50", milliseconds(histogram.percentile_ns(50))},
          {"p99", milliseconds(histogram.percentile_ns(99))},
          {"max", milliseconds(histogram.max_ns())}};
}

/// Calls visit(name, histogram) for decoding, every stage, their total, and what of it came after
/// the turn's end.
template <class Visit>
void for_each_time(const TimeSummary& times, Visit&& visit) {
  visit("decode", times.decode);
  for (std::size_t i = 0; i < times.stages.size(); ++i) {
    visit(std::string(to_string(static_cast<pipeline::Stage>(i))), times.stages[i]);
  }
  visit("total", times.total);
  visit("after_turn", times.after_turn);
}

struct Totals {
  std::uint64_t returns_in = 0, returns_labelled = 0, complete = 0;
};

Totals totals_of(const std::vector<FrameRecord>& records) {
  Totals totals;
  for (const FrameRecord& frame : records) {
    totals.returns_in += frame.returns_in;
    totals.returns_labelled += frame.returns_labelled;
    totals.complete += frame.complete ? 1 : 0;
  }
  return totals;
}

/// How the vehicle's motion and the turns fit together in time.
struct MotionSummary {
  std::uint64_t deskewed = 0;
  double least_ms = 0, median_ms = 0, most_ms = 0;  ///< Newest sample after the turn's last firing.
};

MotionSummary motion_of(const std::vector<FrameRecord>& records) {
  MotionSummary summary;
  std::vector<std::int64_t> newest_ns;
  for (const FrameRecord& frame : records) {
    summary.deskewed += frame.deskew.state == firmware_io::DeskewState::kDone ? 1 : 0;
    newest_ns.push_back(frame.deskew.newest_motion_ns);
  }
  if (newest_ns.empty()) return summary;
  std::ranges::sort(newest_ns);
  summary.least_ms = milliseconds(newest_ns.front());
  summary.median_ms = milliseconds(newest_ns[newest_ns.size() / 2]);
  summary.most_ms = milliseconds(newest_ns.back());
  return summary;
}

std::string motion_sentence(std::uint64_t samples, const std::vector<FrameRecord>& records) {
  const MotionSummary motion = motion_of(records);
  std::string text = fmt::format("{} samples; taken out of {} turns, {} without ego motion",
                                 samples, motion.deskewed, records.size() - motion.deskewed);
  if (samples == 0) return text;
  return text + fmt::format(
                    "\n          newest sample {:+.1f} ms from a turn's end (median; {:+.1f} "
                    "to {:+.1f})",
                    motion.median_ms, motion.least_ms, motion.most_ms);
}

}  // namespace

FrameRecord record_of(const firmware_io::FrameInfo& info,
                      const pipeline::SegmentationReport& segmented, std::int64_t decode_ns,
                      const StageTimes& times, std::int64_t ahead_ns) noexcept {
  FrameRecord record;
  record.number = info.number;
  record.first_packet_ns = info.first_packet_ns;
  record.complete = info.complete;
  record.returns_in = info.returns;
  record.returns_labelled = segmented.ground + segmented.obstacles;
  record.decode_ns = decode_ns;
  record.times = times;
  record.ahead_ns = ahead_ns;
  record.cut = segmented.cut;
  record.deskew = info.deskew;
  record.losses = info.losses;
  return record;
}

void TimeSummary::add(const FrameRecord& frame) noexcept {
  for (std::size_t i = 0; i < stages.size(); ++i) stages[i].record(frame.times.stage_ns[i]);
  decode.record(frame.decode_ns);
  total.record(frame.decode_ns + frame.times.sum_ns());
  after_turn.record(after_turn_ns(frame));
  wall.record(frame.times.segment_wall_ns);
}

std::string TimeSummary::text() const {
  std::string text = fmt::format("ms/frame  {:<16}{:>9}{:>9}{:>9}\n", "", "p50", "p99", "max");
  for_each_time(*this, [&](const std::string& name, const rt::LogLinearHistogram& histogram) {
    if (histogram.max_ns() == 0) return;  // a stage that did not run
    text +=
        fmt::format("          {:<16}{:>9.3f}{:>9.3f}{:>9.3f}\n", name,
                    milliseconds(histogram.percentile_ns(50)),
                    milliseconds(histogram.percentile_ns(99)), milliseconds(histogram.max_ns()));
  });
  return text;
}

Json TimeSummary::json() const {
  Json json;
  for_each_time(*this, [&](const std::string& name, const rt::LogLinearHistogram& histogram) {
    json[name] = percentiles_json(histogram);
  });
  return json;
}

void Report::add(const FrameRecord& frame) {
  records_.push_back(frame);
  times_.add(frame);
}

firmware_io::LossCounters Report::losses() const {
  if (losses_) return *losses_;
  firmware_io::LossCounters losses;
  for (const FrameRecord& frame : records_) losses += frame.losses;
  return losses;
}

std::string Report::text() const {
  const Totals totals = totals_of(records_);
  std::string text;
  if (!run_.sensor.empty()) text += "sensor    " + run_.sensor + "\n";
  if (!run_.calibration.empty()) text += "table     " + run_.calibration + "\n";
  if (!device_clock_.empty()) text += "clock     " + device_clock_ + "\n";
  text += fmt::format("frames    {} ({} complete)\nreturns   {} in, {} labelled\n", records_.size(),
                      totals.complete, totals.returns_in, totals.returns_labelled);
  if (scan_points_ && scan_points_->no_place > 0) {
    text +=
        fmt::format("          {} points null or not finite, labelled 0\n", scan_points_->no_place);
  }
  if (scan_points_ && scan_points_->no_ring > 0) {
    text +=
        fmt::format("          {} points of no ring, labelled obstacle\n", scan_points_->no_ring);
  }
  if (quality_) {
    text += fmt::format("quality   IoU_g {:.2f} %, Recall_o {:.2f} %{}\n",
                        100 * quality_->iou_ground(), 100 * quality_->recall_key_obstacles(),
                        unscored_ == 0 ? "" : fmt::format(" ({} frames not scored)", unscored_));
  }
  if (const std::string line = contradiction_text(mount_); !line.empty()) {
    text += "mount     " + line + "\n";
  }
  if (const std::string line = blind_text(blind_); !line.empty()) {
    text += "blind     " + line + "\n";
  }
  if (motion_samples_) text += "motion    " + motion_sentence(*motion_samples_, records_) + "\n";
  text += "losses    " + loss_sentence(losses()) + "\n";
  text += times_.text();
  if (interrupted_) text += "ended     interrupted: the rest of the input was not read\n";
  return text;
}

Status Report::write_json(const std::filesystem::path& path) const {
  Json json;
  json["terracut"] = TERRACUT_VERSION;
  json["command"] = run_.command;
  json["input"] = run_.input;
  json["interrupted"] = interrupted_;
  if (!input_warning_.empty()) json["input_warning"] = input_warning_;
  if (!run_.sensor.empty()) json["sensor"] = run_.sensor;
  json["calibration"] = run_.calibration;
  if (!device_clock_.empty()) json["device_clock"] = device_clock_;
  if (run_.method.empty()) {
    json["profile"] = run_.profile;
    json["stages"] = run_.stages;
  } else {
    json["method"] = run_.method;
  }
  Json& frames = json["frames"] = Json::array();
  for (const FrameRecord& frame : records_) {
    frames.push_back({{"frame", frame.number},
                      {"first_packet_ns", frame.first_packet_ns},
                      {"complete", frame.complete},
                      {"returns_in", frame.returns_in},
                      {"returns_labelled", frame.returns_labelled},
                      {"losses", losses_json(frame.losses)},
                      {"ms", milliseconds_json(frame)},
                      {"segment_wall_ms", milliseconds(frame.times.segment_wall_ns)},
                      {"min_cut", min_cut_json(frame.cut)}});
    if (motion_samples_) {
      frames.back()["deskewed"] = frame.deskew.state == firmware_io::DeskewState::kDone;
    }
  }
  const Totals totals = totals_of(records_);
  Json& summary = json["summary"];
  summary["frames"] = records_.size();
  summary["complete_frames"] = totals.complete;
  summary["returns_in"] = totals.returns_in;
  summary["returns_labelled"] = totals.returns_labelled;
  summary["losses"] = losses_json(losses());
  summary["ms"] = times_.json();
  summary["segment_wall_ms"] = percentiles_json(times_.wall);
  if (quality_) {
    summary["iou_g"] = quality_->iou_ground();
    summary["recall_o"] = quality_->recall_key_obstacles();
    summary["unscored_frames"] = unscored_;
  }
  if (scan_points_) {
    summary["points_no_place"] = scan_points_->no_place;
    summary["points_no_ring"] = scan_points_->no_ring;
  }
  summary["mount"] = mount_json(mount_);
  summary["blind"] = blind_json(blind_);
  if (motion_samples_) {
    const MotionSummary motion = motion_of(records_);
    summary["motion"] = {
        {"samples", *motion_samples_},
        {"deskewed_frames", motion.deskewed},
        {"newest_sample_after_turn_ms",
         {{"min", motion.least_ms}, {"median", motion.median_ms}, {"max", motion.most_ms}}}};
  }
  return rt::write_whole_file(path, json.dump(1) + "\n");
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
