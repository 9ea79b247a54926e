// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "evaluation_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "pipeline/ground/parameter_table.hpp"
#include "tools/research/baselines/parameter_table.hpp"
#include "tools/research/statistics/measure_json.hpp"
#include "tools/research/statistics/measures.hpp"

namespace terracut::eval {
namespace {

using Json = nlohmann::ordered_json;
using quality::Quality;
using statistics::mean, statistics::number_if;

/// A scope with its name in the report; all scopes are shown side by side.
struct NamedScope {
  std::string_view name;
  statistics::Scope scope;
};
const NamedScope kScopes[] = {
    {"all", {datasets::GroundDefinition::kAll, true, {}}},
    {"road", {datasets::GroundDefinition::kRoad, true, {}}},
    {"all_vegetation_ignored", {datasets::GroundDefinition::kAll, false, {}}},
};
constexpr std::string_view kMeasures[] = {"iou_g", "recall_o", "precision", "recall", "f1"};

bool has_ground(const Quality& q) {
  return q.ground_as_ground + q.ground_as_obstacle + q.obstacle_as_ground > 0;
}

Json measures_json(const Quality& q) {
  return {
      {"iou_g", statistics::iou_g(q)},
      {"recall_o", statistics::recall_o(q)},
      {"precision", number_if(q.ground_as_ground + q.obstacle_as_ground > 0, q.precision_ground())},
      {"recall", number_if(q.ground_as_ground + q.ground_as_obstacle > 0, q.recall_ground())},
      {"f1", number_if(has_ground(q), statistics::f1_ground(q))}};
}

Json tall_json(const statistics::TallCounts& tall) {
  return {{"returns", tall.returns},
          {"as_ground", tall.as_ground},
          {"share", number_if(tall.returns > 0, static_cast<double>(tall.as_ground) /
                                                    static_cast<double>(tall.returns))}};
}

Json flips_json(const statistics::FlipCounts& flips) {
  const auto of_returns = [&](std::uint64_t count) {
    return number_if(flips.returns > 0,
                     static_cast<double>(count) / static_cast<double>(flips.returns));
  };
  return {{"returns", flips.returns},
          {"flips", flips.flips},
          {"true_flips", flips.true_flips},
          {"share", of_returns(flips.flips)},
          {"true_share", of_returns(flips.true_flips)}};
}

/// Returns {min, mean, max} of the defined values.
Json spread(const std::vector<Json>& values) {
  std::optional<double> least, most;
  for (const Json& value : values) {
    if (value.is_null()) continue;
    const double number = value.get<double>();
    least = std::min(least.value_or(number), number);
    most = std::max(most.value_or(number), number);
  }
  return {{"min", number_if(least.has_value(), least.value_or(0))},
          {"mean", mean(values)},
          {"max", number_if(most.has_value(), most.value_or(0))}};
}

double milliseconds(std::int64_t ns) {
  return static_cast<double>(ns / 1000) / 1000.0;
}

/// Returns {mean, p50, p99, max}; percentiles are by nearest rank.
Json times_json(std::vector<std::int64_t> times_ns) {
  if (times_ns.empty()) return nullptr;
  std::ranges::sort(times_ns);
  const auto rank = [&](double percent) {
    const double place = std::ceil(percent / 100.0 * static_cast<double>(times_ns.size()));
    return times_ns[static_cast<std::size_t>(std::max(place, 1.0)) - 1];
  };
  double sum = 0;
  for (const std::int64_t ns : times_ns) sum += static_cast<double>(ns);
  return {
      {"mean", milliseconds(static_cast<std::int64_t>(sum / static_cast<double>(times_ns.size())))},
      {"p50", milliseconds(rank(50))},
      {"p99", milliseconds(rank(99))},
      {"max", milliseconds(times_ns.back())}};
}

/// One method's frames, by sequence.
using BySequence = std::map<std::string, std::vector<const FrameResults::value_type*>>;

BySequence frames_of(const FrameResults& results, const std::string& method) {
  BySequence frames;
  for (const auto& entry : results) {
    if (entry.first.method == method) frames[entry.first.sequence].push_back(&entry);
  }
  return frames;
}

template <class Counts>
Counts sum_of(std::span<const FrameResults::value_type* const> frames,
              Counts FrameResult::* counts) {
  Counts sum;
  for (const auto* frame : frames) sum += frame->second.*counts;
  return sum;
}

/// The results of one method on the dataset.
class MethodJson {
 public:
  MethodJson(const MethodChoice& method, const datasets::ClassTable& classes,
             const FrameResults& results)
      : method_(method), classes_(classes), frames_(frames_of(results, method.name)) {
    for (const auto& [name, frames] : frames_) {
      counts_[name] = sum_of(std::span(frames), &FrameResult::counts);
      total_ += counts_[name];
    }
  }

  [[nodiscard]] Json json() const {
    Json json{{"about", method_.about}};
    const auto add = [&](const auto& parameter, const auto& config) {
      json["parameters"][std::string(parameter.key)] = parameter.text(config);
    };
    if (method_.config.kind == baselines::MethodKind::kSegmenter) {
      for (const auto& parameter : ground::parameters()) add(parameter, method_.config.segmenter);
    } else {
      for (const auto& parameter : baselines::parameters()) {
        if (parameter.key.starts_with(method_.base + ".")) add(parameter, method_.config);
      }
    }
    json["mean_over_sequences"] = means(statistics::quality_of);
    for (const NamedScope& named : kScopes) {
      json["pooled"][std::string(named.name)] =
          measures_json(statistics::quality_of(total_, classes_, named.scope));
    }
    statistics::TallCounts tall;
    statistics::FlipCounts flips;
    for (const auto& [name, frames] : frames_) {
      tall += sum_of(std::span(frames), &FrameResult::tall);
      flips += sum_of(std::span(frames), &FrameResult::flips);
    }
    json["pooled"]["tall"] = tall_json(tall);
    json["pooled"]["flips"] = flips_json(flips);
    json["by_range"] = by_range(datasets::GroundDefinition::kAll);
    json["by_range_road"] = by_range(datasets::GroundDefinition::kRoad);
    json["by_class"] = by_class();
    json["ms"] = times();
    json["lost"] = lost();
    json["sequences"] = sequences();
    json["frames"] = frames();
    return json;
  }

  /// Returns the measures of the qualities that `judge` gives for the same points: means, and each
  /// sequence's.
  template <class Judge>
  [[nodiscard]] Json oracle(Judge&& judge) const {
    Json json = means(judge);
    Json& sequences = json["sequences"] = Json::object();
    for (const NamedScope& named : kScopes) {
      for (const auto& [name, counts] : counts_) {
        sequences[name][std::string(named.name)] =
            measures_json(judge(counts, classes_, named.scope));
      }
    }
    return json;
  }

 private:
  /// Returns every measure in every scope: the mean over sequences of the qualities that `judge`
  /// gives.
  template <class Judge>
  [[nodiscard]] Json means(Judge&& judge) const {
    Json json = Json::object();
    for (const NamedScope& named : kScopes) {
      std::vector<Json> of_sequences;
      for (const auto& [name, counts] : counts_) {
        of_sequences.push_back(measures_json(judge(counts, classes_, named.scope)));
      }
      for (const std::string_view measure : kMeasures) {
        std::vector<Json> values;
        for (const Json& of_sequence : of_sequences) values.push_back(of_sequence.at(measure));
        json[std::string(named.name)][std::string(measure)] = mean(values);
      }
    }
    return json;
  }

  [[nodiscard]] Json by_range(datasets::GroundDefinition ground) const {
    Json json = Json::object();
    for (std::size_t band = 0; band < statistics::kRangeBands; ++band) {
      json[std::string(statistics::kRangeBandNames[band])] =
          measures_json(statistics::quality_of(total_, classes_, {.ground = ground, .band = band}));
    }
    return json;
  }

  [[nodiscard]] Json by_class() const {
    std::map<std::uint16_t, statistics::LabelCounts> classes;
    for (const auto& [key, labels] : total_.by_class_and_band()) classes[key.class_id] += labels;
    Json list = Json::array();
    for (const auto& [id, labels] : classes) {
      const datasets::ClassEntry* const entry = classes_.find(id);
      list.push_back(
          {{"id", id},
           {"name", entry == nullptr ? "" : entry->name},
           {"points", labels.ground + labels.obstacle},
           {"as_ground", labels.ground},
           {"as_other_ground", labels.other_ground},
           {"share_as_ground", static_cast<double>(labels.ground) /
                                   static_cast<double>(labels.ground + labels.obstacle)},
           {"share_as_other_ground", static_cast<double>(labels.other_ground) /
                                         static_cast<double>(labels.ground + labels.obstacle)}});
    }
    return list;
  }

  [[nodiscard]] Json times() const {
    std::map<std::string, std::vector<std::int64_t>> by_stage;
    std::vector<std::int64_t> segment, decode;
    for (const auto& [name, frames] : frames_) {
      for (const auto* frame : frames) {
        const FrameTimes& times = frame->second.times;
        segment.push_back(times.segment_ns);
        if (times.decode_ns > 0) decode.push_back(times.decode_ns);
      }
    }
    Json json{{"segment", times_json(std::move(segment))}};
    if (!decode.empty()) json["decode"] = times_json(std::move(decode));
    for (std::size_t stage = 0; stage < stage::kStages; ++stage) {
      std::vector<std::int64_t> of_stage;
      bool any = false;
      for (const auto& [name, frames] : frames_) {
        for (const auto* frame : frames) {
          of_stage.push_back(frame->second.times.stage_ns[stage]);
          any |= of_stage.back() > 0;
        }
      }
      const auto name = to_string(static_cast<stage::Stage>(stage));
      if (any) json[std::string(name)] = times_json(std::move(of_stage));
    }
    return json;
  }

  [[nodiscard]] Json lost() const {
    std::uint64_t no_ring = 0, not_placed = 0, non_finite = 0, realigned = 0;
    for (const auto& [name, frames] : frames_) {
      for (const auto* frame : frames) {
        no_ring += frame->second.no_ring;
        not_placed += frame->second.not_placed;
        non_finite += frame->second.non_finite;
        realigned += frame->second.rings_realigned ? 1 : 0;
      }
    }
    return {{"points_without_ring", no_ring},
            {"points_not_placed", not_placed},
            {"points_not_finite", non_finite},
            {"frames_realigned", realigned}};
  }

  [[nodiscard]] Json frame_measures(const statistics::FrameCounts& counts) const {
    const Quality all = statistics::quality_of(counts, classes_, {});
    const Quality road =
        statistics::quality_of(counts, classes_, {.ground = datasets::GroundDefinition::kRoad});
    return {{"iou_g", statistics::iou_g(all)},
            {"recall_o", statistics::recall_o(all)},
            {"iou_road", statistics::iou_g(road)}};
  }

  [[nodiscard]] Json sequences() const {
    Json json = Json::object();
    for (const auto& [name, frames] : frames_) {
      Json& sequence = json[name];
      std::uint64_t points = 0;
      std::map<std::string, std::vector<Json>> of_frames;
      for (const auto* frame : frames) {
        points += frame->second.points;
        const Json measures = frame_measures(frame->second.counts);
        for (const auto& [measure, value] : measures.items()) {
          of_frames[measure].push_back(value);
        }
      }
      sequence["frames"] = frames.size();
      sequence["points"] = points;
      sequence["tall"] = tall_json(sum_of(std::span(frames), &FrameResult::tall));
      sequence["flips"] = flips_json(sum_of(std::span(frames), &FrameResult::flips));
      for (const NamedScope& named : kScopes) {
        sequence[std::string(named.name)] =
            measures_json(statistics::quality_of(counts_.at(name), classes_, named.scope));
      }
      for (const std::string measure : {"iou_g", "recall_o", "iou_road"}) {
        sequence["frame_" + measure] = spread(of_frames[measure]);
      }
      std::vector<std::int64_t> times_ns;
      for (const auto* frame : frames) times_ns.push_back(frame->second.times.segment_ns);
      sequence["ms"] = times_json(std::move(times_ns));
    }
    return json;
  }

  [[nodiscard]] Json frames() const {
    Json list = Json::array();
    for (const auto& [name, frames] : frames_) {
      for (const auto* entry : frames) {
        const FrameResult& result = entry->second;
        Json frame{{"sequence", name}, {"frame", entry->first.frame}, {"points", result.points}};
        frame.update(frame_measures(result.counts));
        frame["ms"] = milliseconds(result.times.segment_ns);
        if (result.times.decode_ns > 0) frame["decode_ms"] = milliseconds(result.times.decode_ns);
        list.push_back(std::move(frame));
      }
    }
    return list;
  }

  const MethodChoice& method_;
  const datasets::ClassTable& classes_;
  BySequence frames_;
  std::map<std::string, statistics::FrameCounts> counts_;  ///< Keyed by sequence.
  statistics::FrameCounts total_;
};

std::string_view role_name(datasets::Role role) {
  switch (role) {
    case datasets::Role::kGround:
      return "ground";
    case datasets::Role::kOrdinaryObstacle:
      return "ordinary";
    case datasets::Role::kKeyObstacle:
      return "key";
    case datasets::Role::kIgnored:
      break;
  }
  return "ignored";
}

Json classes_json(const datasets::ClassTable& classes) {
  Json list = Json::array();
  for (const datasets::ClassEntry& entry : classes.entries()) {
    list.push_back({{"id", entry.id},
                    {"name", entry.name},
                    {"all", role_name(entry.role(datasets::GroundDefinition::kAll))},
                    {"road", role_name(entry.role(datasets::GroundDefinition::kRoad))},
                    {"vegetation", entry.vegetation}});
  }
  return list;
}

Json warnings_json(const datasets::ClassTable& classes, const FrameResults& results) {
  std::map<std::uint16_t, std::string> first_met;
  for (const auto& [key, result] : results) {
    for (const auto& [count, labels] : result.counts.by_class_and_band()) {
      if (classes.find(count.class_id) != nullptr) continue;
      first_met.emplace(count.class_id, key.sequence + "/" + key.frame);
    }
  }
  Json list = Json::array();
  for (const auto& [id, where] : first_met) {
    list.push_back({{"where", where},
                    {"what", fmt::format("class {} is not in the class table; its points count "
                                         "nowhere",
                                         id)}});
  }
  return list;
}

}  // namespace

Json evaluation_json(const EvaluationFacts& facts, const datasets::ClassTable& classes,
                     const EvaluationOutcome& outcome) {
  Json json{{"terracut", TERRACUT_VERSION},
            {"dataset", facts.dataset},
            {"root", facts.root},
            {"through_packets", facts.through_packets},
            {"complete", !outcome.interrupted && outcome.faults.empty()},
            {"interrupted", outcome.interrupted},
            {"classes", classes_json(classes)}};
  for (const MethodChoice& method : facts.methods) {
    const MethodJson of_method(method, classes, outcome.results);
    json["methods"][method.name] = of_method.json();
    if (json.contains("oracles")) continue;  // the oracles are the same for every method
    json["oracles"] = {{"everything_ground", of_method.oracle(statistics::everything_ground)},
                       {"perfect_ground", of_method.oracle(statistics::perfect_ground)}};
  }
  json["faults"] = Json::array();
  for (const Fault& fault : outcome.faults) {
    json["faults"].push_back({{"where", fault.where}, {"what", fault.what}});
  }
  json["warnings"] = warnings_json(classes, outcome.results);
  return json;
}

std::string evaluation_text(const Json& evaluation) {
  const auto percent = [](const Json& share) {
    return share.is_null() ? std::string("-") : fmt::format("{:.2f}", 100 * share.get<double>());
  };
  std::string text =
      fmt::format("{:<28}{:>8}{:>8}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n", "mean over sequences, %",
                  "IoU", "F1", "Recall_o", "worst", "IoU-veg", "IoU-road", "p50 ms", "p99 ms");
  for (const auto& [name, method] : evaluation.at("methods").items()) {
    const Json& means = method.at("mean_over_sequences");
    std::vector<Json> worst;
    for (const auto& [sequence, of_sequence] : method.at("sequences").items()) {
      worst.push_back(of_sequence.at("frame_recall_o").at("min"));
    }
    const Json& ms = method.at("ms").at("segment");
    const auto time = [&](const char* which) {
      return ms.is_null() ? std::string("-") : fmt::format("{:.2f}", ms.at(which).get<double>());
    };
    text += fmt::format("{:<28}{:>8}{:>8}{:>9}{:>9}{:>9}{:>9}{:>9}{:>9}\n", name,
                        percent(means.at("all").at("iou_g")), percent(means.at("all").at("f1")),
                        percent(means.at("all").at("recall_o")), percent(spread(worst).at("min")),
                        percent(means.at("all_vegetation_ignored").at("iou_g")),
                        percent(means.at("road").at("iou_g")), time("p50"), time("p99"));
  }
  if (evaluation.at("interrupted").get<bool>()) {
    text += "interrupted: only some of the frames are in these figures\n";
  }
  if (!evaluation.contains("oracles")) return text;
  for (const auto& [name, oracle] : evaluation.at("oracles").items()) {
    text += fmt::format("{:<28}{:>8}{:>8}{:>9}{:>9}{:>9}{:>9}\n", "oracle: " + name,
                        percent(oracle.at("all").at("iou_g")), percent(oracle.at("all").at("f1")),
                        percent(oracle.at("all").at("recall_o")), "",
                        percent(oracle.at("all_vegetation_ignored").at("iou_g")),
                        percent(oracle.at("road").at("iou_g")));
  }
  return text;
}

}  // namespace terracut::eval
