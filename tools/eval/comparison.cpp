// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "comparison.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <utility>

namespace terracut::evaluation {
namespace {

using Json = nlohmann::ordered_json;

/// One frame's figures by measure; what is null in the report is absent.
using Figures = std::map<std::string, double>;
using Frames = std::map<std::pair<std::string, std::string>, Figures>;  ///< By sequence and frame.

struct Measure {
  const char* name;
  bool more_is_better;
};
constexpr Measure kMeasures[] = {
    {"iou_g", true}, {"recall_o", true}, {"iou_road", true}, {"ms", false}};

/// Why a file is no report to compare: what of it is missing or of another kind.
tl::unexpected<Error> no_report(const Compared& side, const std::string& lacks) {
  return fail(
      ErrorCode::kMalformed,
      fmt::format("{}: expected a report of `terracut eval --json`, but {}", side.name, lacks));
}

/// Null: the object has none of that name.
const Json* member(const Json& object, const std::string& name) {
  const auto found = object.find(name);
  return found == object.end() ? nullptr : &*found;
}

Status add_frame(const Json& frame, Frames& frames) {
  const auto lacking = [](const char* name) {
    return fail(ErrorCode::kMalformed, fmt::format("one of its frames has no '{}'", name));
  };
  const Json* const sequence = member(frame, "sequence");
  const Json* const name = member(frame, "frame");
  if (sequence == nullptr || !sequence->is_string()) return lacking("sequence");
  if (name == nullptr || !name->is_string()) return lacking("frame");
  Figures& figures = frames[{sequence->get<std::string>(), name->get<std::string>()}];
  for (const Measure& measure : kMeasures) {
    const Json* const value = member(frame, measure.name);
    if (value == nullptr || !(value->is_null() || value->is_number())) return lacking(measure.name);
    if (value->is_number()) figures[measure.name] = value->get<double>();
  }
  return {};
}

/// The method's part of a report.
Expected<const Json*> method_of(const Compared& side) {
  const Json* const methods = member(side.report, "methods");
  if (methods == nullptr || !methods->is_object()) return no_report(side, "it has no 'methods'");
  if (const Json* const method = member(*methods, side.method)) return method;
  std::string known;
  for (const auto& [each, ignored] : methods->items()) known += (known.empty() ? "" : ", ") + each;
  return fail(ErrorCode::kMalformed,
              fmt::format("{}: there is no method '{}' in the report, only {}", side.name,
                          side.method, known));
}

Expected<Frames> frames_of(const Compared& side) {
  const auto method = method_of(side);
  if (!method) return tl::unexpected(method.error());
  const Json* const list = member(**method, "frames");
  if (list == nullptr || !list->is_array()) {
    return no_report(side, fmt::format("its method '{}' has no 'frames'", side.method));
  }
  Frames frames;
  for (const Json& frame : *list) {
    if (const Status added = add_frame(frame, frames); !added) {
      return no_report(side, added.error().message);
    }
  }
  return frames;
}

/// What eval printed for the measure.
std::optional<double> mean_of_eval(const Compared& side, const std::string& measure) {
  const bool road = measure == "iou_road";
  const Json* at = *method_of(side);
  for (const char* const name :
       {"mean_over_sequences", road ? "road" : "all", road ? "iou_g" : measure.c_str()}) {
    at = member(*at, name);
    if (at == nullptr) return std::nullopt;
  }
  return at->is_number() ? std::optional(at->get<double>()) : std::nullopt;
}

MeasureChange change_of(const Measure& measure, const Frames& before, const Frames& after) {
  MeasureChange change{.measure = measure.name,
                       .more_is_better = measure.more_is_better,
                       .frames = {},
                       .sequences = {},
                       .eval_before = {},
                       .eval_after = {}};
  std::vector<double> differences;
  std::map<std::string, std::vector<double>> by_sequence;
  for (const auto& [key, was] : before) {
    const auto found = after.find(key);
    if (found == after.end()) continue;
    const auto a = was.find(measure.name), b = found->second.find(measure.name);
    if (a == was.end() || b == found->second.end()) continue;
    change.before += a->second;
    change.after += b->second;
    differences.push_back(b->second - a->second);
    by_sequence[key.first].push_back(differences.back());
  }
  change.frames = signed_rank_test(differences);
  if (differences.empty()) return change;
  change.before /= static_cast<double>(differences.size());
  change.after /= static_cast<double>(differences.size());
  if (by_sequence.size() < 2 || by_sequence.size() > 20) return change;
  std::vector<double> means;
  for (const auto& [name, of_sequence] : by_sequence) {
    double sum = 0;
    for (const double difference : of_sequence) sum += difference;
    means.push_back(sum / static_cast<double>(of_sequence.size()));
  }
  change.sequences = sign_flip_test(means);
  return change;
}

Json test_json(const PairedTest& test) {
  return {{"pairs", test.pairs},
          {"greater", test.better},
          {"less", test.worse},
          {"mean", test.mean},
          {"p", test.p}};
}

}  // namespace

std::string Comparison::worse(double significance) const {
  std::string names;
  for (const MeasureChange& change : changes) {
    if (change.worse(significance)) names += (names.empty() ? "" : ", ") + change.measure;
  }
  return names;
}

Expected<Comparison> compare(const Compared& before, const Compared& after) {
  const auto was = frames_of(before);
  if (!was) return tl::unexpected(was.error());
  const auto is = frames_of(after);
  if (!is) return tl::unexpected(is.error());
  Comparison comparison;
  comparison.before = before.method + " of " + before.name;
  comparison.after = after.method + " of " + after.name;
  for (const auto& [key, figures] : *was)
    ++(is->contains(key) ? comparison.frames : comparison.only_before);
  comparison.only_after = is->size() - comparison.frames;
  if (comparison.frames == 0) {
    return fail(ErrorCode::kInvalidArgument, "the two reports have no frame in common");
  }
  const bool same_frames = comparison.only_before + comparison.only_after == 0;
  for (const Measure& measure : kMeasures) {
    MeasureChange change = change_of(measure, *was, *is);
    if (same_frames) {
      change.eval_before = mean_of_eval(before, change.measure);
      change.eval_after = mean_of_eval(after, change.measure);
    }
    comparison.changes.push_back(std::move(change));
  }
  return comparison;
}

std::string comparison_text(const Comparison& comparison, double significance) {
  std::string text = fmt::format("before    {}\nafter     {}\nframes    {} in both",
                                 comparison.before, comparison.after, comparison.frames);
  if (comparison.only_before + comparison.only_after > 0) {
    text += fmt::format(", {} only before, {} only after", comparison.only_before,
                        comparison.only_after);
  }
  const auto line = [&](const char* form, const MeasureChange& change, double before,
                        double after) {
    const double unit = change.measure == "ms" ? 1 : 100;  // shares as percent
    text += fmt::format(fmt::runtime(form), change.measure, unit * before, unit * after,
                        unit * (after - before));
  };
  text +=
      fmt::format("\n\n{:<18}{:>9}{:>9}{:>9}{:>8}{:>8}{:>12}{:>15}\n", "mean of frames", "before",
                  "after", "change", "frames+", "frames-", "p (frames)", "p (sequences)");
  for (const MeasureChange& change : comparison.changes) {
    line("{:<18}{:>9.3f}{:>9.3f}{:>+9.3f}", change, change.before, change.after);
    text += fmt::format(
        "{:>8}{:>8}{:>12.2g}{:>15}\n", change.frames.better, change.frames.worse, change.frames.p,
        change.sequences ? fmt::format("{:.2g}", change.sequences->p) : std::string("-"));
  }
  if (comparison.only_before + comparison.only_after == 0) {
    text += "as eval prints them, means over sequences of all their points together\n";
  }
  for (const MeasureChange& change : comparison.changes) {
    if (!change.eval_before || !change.eval_after) continue;
    line("{:<18}{:>9.3f}{:>9.3f}{:>+9.3f}\n", change, *change.eval_before, *change.eval_after);
  }
  const std::string worse = comparison.worse(significance);
  return text + fmt::format("worse     {} (by p (frames) below {:g}; ms is not judged)\n",
                            worse.empty() ? "nothing" : worse, significance);
}

Json comparison_json(const Comparison& comparison) {
  Json json{{"before", comparison.before},
            {"after", comparison.after},
            {"frames", comparison.frames},
            {"only_before", comparison.only_before},
            {"only_after", comparison.only_after}};
  for (const MeasureChange& change : comparison.changes) {
    Json& entry = json["measures"][change.measure];
    entry = {
        {"before", change.before}, {"after", change.after}, {"frames", test_json(change.frames)}};
    entry["sequences"] = change.sequences ? test_json(*change.sequences) : Json(nullptr);
    entry["eval_before"] = change.eval_before ? Json(*change.eval_before) : Json(nullptr);
    entry["eval_after"] = change.eval_after ? Json(*change.eval_after) : Json(nullptr);
  }
  return json;
}

}  // namespace terracut::evaluation
