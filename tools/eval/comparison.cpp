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

Expected<Frames> frames_of(const Json& report, std::string_view method) {
  try {
    const Json& methods = report.at("methods");
    const std::string name(method);
    if (!methods.contains(name)) {
      std::string known;
      for (const auto& [each, ignored] : methods.items())
        known += (known.empty() ? "" : ", ") + each;
      return fail(ErrorCode::kMalformed,
                  fmt::format("there is no method '{}' in the report, only {}", method, known));
    }
    Frames frames;
    for (const Json& frame : methods.at(name).at("frames")) {
      Figures& figures =
          frames[{frame.at("sequence").get<std::string>(), frame.at("frame").get<std::string>()}];
      for (const Measure& measure : kMeasures) {
        const Json& value = frame.at(measure.name);
        if (!value.is_null()) figures[measure.name] = value.get<double>();
      }
    }
    return frames;
  } catch (const Json::exception& error) {
    return fail(ErrorCode::kMalformed,
                fmt::format("no report of `terracut eval`: {}", error.what()));
  }
}

MeasureChange change_of(const Measure& measure, const Frames& before, const Frames& after) {
  MeasureChange change{.measure = measure.name,
                       .more_is_better = measure.more_is_better,
                       .frames = {},
                       .sequences = {}};
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

Expected<Comparison> compare(const Json& before, std::string_view method_before, const Json& after,
                             std::string_view method_after) {
  const auto was = frames_of(before, method_before);
  if (!was) return tl::unexpected(was.error());
  const auto is = frames_of(after, method_after);
  if (!is) return tl::unexpected(is.error());
  Comparison comparison;
  for (const auto& [key, figures] : *was)
    ++(is->contains(key) ? comparison.frames : comparison.only_before);
  comparison.only_after = is->size() - comparison.frames;
  if (comparison.frames == 0) {
    return fail(ErrorCode::kInvalidArgument, "the two reports have no frame in common");
  }
  for (const Measure& measure : kMeasures) {
    comparison.changes.push_back(change_of(measure, *was, *is));
  }
  return comparison;
}

std::string comparison_text(const Comparison& comparison) {
  std::string text = fmt::format("before    {}\nafter     {}\nframes    {} in both",
                                 comparison.before, comparison.after, comparison.frames);
  if (comparison.only_before + comparison.only_after > 0) {
    text += fmt::format(", {} only before, {} only after", comparison.only_before,
                        comparison.only_after);
  }
  text += fmt::format("\n\n{:<10}{:>9}{:>9}{:>9}{:>8}{:>8}{:>12}{:>15}\n", "mean", "before",
                      "after", "change", "frames+", "frames-", "p (frames)", "p (sequences)");
  for (const MeasureChange& change : comparison.changes) {
    const double unit = change.measure == "ms" ? 1 : 100;  // shares as percent
    text += fmt::format(
        "{:<10}{:>9.3f}{:>9.3f}{:>+9.3f}{:>8}{:>8}{:>12.2g}{:>15}\n", change.measure,
        unit * change.before, unit * change.after, unit * (change.after - change.before),
        change.frames.better, change.frames.worse, change.frames.p,
        change.sequences ? fmt::format("{:.2g}", change.sequences->p) : std::string("-"));
  }
  return text;
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
  }
  return json;
}

}  // namespace terracut::evaluation
