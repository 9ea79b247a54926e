// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "object_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/research/statistics/measure_json.hpp"

namespace terracut::object_measures {
namespace {

using Json = nlohmann::ordered_json;

Json instances_json(const InstanceCounts& counts) {
  const std::uint64_t instances = counts.found + counts.missed;
  return {{"instances", instances},
          {"found", counts.found},
          {"false_objects", counts.false_objects},
          {"pq",
           statistics::number_if(instances + counts.false_objects > 0, counts.panoptic_quality())},
          {"recall", statistics::number_if(instances > 0, counts.recall())}};
}

Json counts_json(const ObjectCounts& counts) {
  const auto of_frame = [&](const Spread& spread) -> Json {
    return {{"mean", spread.mean(counts.frames)}, {"deviation", spread.deviation(counts.frames)}};
  };
  Json json{{"frames", counts.frames}};
  if (counts.frames == 0) return json;
  json["objects"] = counts.objects.mean(counts.frames);
  json["milliseconds"] = counts.milliseconds.mean(counts.frames);
  json["ose"] = of_frame(counts.over_segmentation);
  json["use"] = of_frame(counts.under_segmentation);
  Json all = instances_json(counts.instances.all());
  all["kind"] = "all";
  json["instances"].push_back(std::move(all));
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    Json of_kind = instances_json(counts.instances.of(static_cast<Kind>(kind)));
    of_kind["kind"] = kKindNames[kind];
    for (std::size_t band = 0; band < statistics::kRangeBands; ++band) {
      Json of_band = instances_json(counts.instances.counts[kind][band]);
      of_band["range"] = statistics::kRangeBandNames[band];
      of_kind["bands"].push_back(std::move(of_band));
    }
    json["instances"].push_back(std::move(of_kind));
  }
  return json;
}

std::string percent(const Json& share) {
  return share.is_null() ? "-" : fmt::format("{:.1f}", 100 * share.get<double>());
}

/// Returns "1.2 (0.3)", mean and deviation.
std::string spread_text(const Json& spread) {
  return fmt::format("{:.1f} ({:.1f})", spread.at("mean").get<double>(),
                     spread.at("deviation").get<double>());
}

}  // namespace

Json object_json(const SplitCounts& counts) {
  return {{"tuned", counts_json(counts.tuned)}, {"unseen", counts_json(counts.unseen)}};
}

std::string object_text(const std::string& method, const Json& json) {
  std::string text = fmt::format(
      "{}: objects\n| | frames | objects | OSE | USE | ms a frame | kind | PQ | recall | "
      "recall {} |\n|---|---|---|---|---|---|---|---|---|---|\n",
      method, fmt::join(statistics::kRangeBandNames, ", "));
  for (const auto& [split, counts] : json.items()) {
    if (counts.at("frames") == 0) continue;
    std::string begin = fmt::format(
        "| {} | {} | {:.0f} | {} | {} | {:.2f} |", split, counts.at("frames").get<std::uint64_t>(),
        counts.at("objects").get<double>(), spread_text(counts.at("ose")),
        spread_text(counts.at("use")), counts.at("milliseconds").get<double>());
    for (const Json& of_kind : counts.at("instances")) {
      std::string bands;
      for (const Json& band : of_kind.value("bands", Json::array())) {
        bands += (bands.empty() ? "" : ", ") + percent(band.at("recall"));
      }
      text +=
          fmt::format("{} {} ({}) | {} | {} | {} |\n", begin, of_kind.at("kind").get<std::string>(),
                      of_kind.at("instances").get<std::uint64_t>(), percent(of_kind.at("pq")),
                      percent(of_kind.at("recall")), bands);
      begin = "| | | | | | |";
    }
  }
  return text;
}

}  // namespace terracut::object_measures
