// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "free_report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "tools/research/hazards/spots.hpp"
#include "tools/research/statistics/measure_json.hpp"

namespace terracut::free_measures {
namespace {

using Json = nlohmann::ordered_json;

Json put_in_json(std::span<const PutIn> bins) {
  Json json = Json::array();
  for (std::size_t bin = 0; bin < bins.size(); ++bin) {
    if (bins[bin].trials == 0) continue;
    json.push_back(
        {{"from_m", hazards::kRangeBins[bin].from_m},
         {"to_m", hazards::kRangeBins[bin].to_m},
         {"trials", bins[bin].trials},
         {"failed", bins[bin].failed},
         {"nearer", bins[bin].nearer},
         {"worst_m", statistics::number_if(std::isfinite(bins[bin].worst_m), bins[bin].worst_m)}});
  }
  return json;
}

std::string number(const Json& value) {
  return value.is_null() ? "-" : fmt::format("{:.2f}", value.get<double>());
}

}  // namespace

Json free_json(const FreeCounts& counts) {
  const auto frames = static_cast<double>(counts.frames);
  const auto sectors = static_cast<double>(counts.sectors);
  Json json{{"frames", counts.frames},
            {"milliseconds", statistics::number_if(frames > 0, counts.milliseconds / frames)},
            {"seen_m", statistics::number_if(frames > 0, counts.seen_m / sectors)}};
  for (std::size_t i = 0; i < counts.seen_ends.size(); ++i) {
    json["seen_ends"][std::string(free_way::kSeenEndNames[i])] =
        statistics::number_if(frames > 0, static_cast<double>(counts.seen_ends[i]) / sectors);
  }
  json["obstacles"] = {{"right", counts.obstacles.right},
                       {"nearer", counts.obstacles.nearer},
                       {"farther", counts.obstacles.farther},
                       {"empty", counts.obstacles.empty}};
  json["boxes"] = put_in_json(counts.boxes);
  json["pits"] = put_in_json(counts.pits);
  return json;
}

std::string free_text(const std::string& method, const Json& json) {
  const Json& obstacles = json.at("obstacles");
  std::string text = fmt::format(
      "{}: free way\n| frames | ms a frame | seen, mean | nearest obstacle up to {:.0f} m: right | "
      "nearer | farther | none |\n|---|---|---|---|---|---|---|\n"
      "| {} | {} | {} m | {} | {} | {} | {} |\n",
      method, kJudged_m, json.at("frames").get<std::uint64_t>(), number(json.at("milliseconds")),
      number(json.at("seen_m")), obstacles.at("right").get<std::uint64_t>(),
      obstacles.at("nearer").get<std::uint64_t>(), obstacles.at("farther").get<std::uint64_t>(),
      obstacles.at("empty").get<std::uint64_t>());
  text += "| put in | range | trials | failed | nearer | worst |\n|---|---|---|---|---|---|\n";
  for (const char* const what : {"boxes", "pits"}) {
    for (const Json& bin : json.at(what)) {
      text +=
          fmt::format("| {} | {:.0f} to {:.0f} m | {} | {} | {} | {} m |\n", what,
                      bin.at("from_m").get<double>(), bin.at("to_m").get<double>(),
                      bin.at("trials").get<std::uint64_t>(), bin.at("failed").get<std::uint64_t>(),
                      bin.at("nearer").get<std::uint64_t>(), number(bin.at("worst_m")));
    }
  }
  return text;
}

}  // namespace terracut::free_measures
