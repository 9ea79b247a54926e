// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sight_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sight_effect.hpp"

namespace terracut::sight_measures {

using Json = nlohmann::ordered_json;

Json sight_json(const SightCounts& counts) {
  Json json{{"turns", counts.turns},
            {"alarms", counts.alarms},
            {"standing_turns", counts.standing_turns},
            {"standing_alarms", counts.standing_alarms},
            {"effects", Json::array()}};
  for (std::size_t i = 0; i < counts.effects.size(); ++i) {
    const EffectCounts& effect = counts.effects[i];
    if (effect.sequences == 0) continue;
    json["effects"].push_back({{"effect", sight_effects()[i].word},
                               {"cause", to_string(sight_effects()[i].cause)},
                               {"sequences", effect.sequences},
                               {"named", effect.named},
                               {"most_turns", effect.most_turns},
                               {"wrong_turns", effect.wrong_turns}});
  }
  return json;
}

std::string sight_text(const std::string& method, const Json& json) {
  std::string text = fmt::format(
      "{}: visibility: {} turns as they are, {} with a false alarm; as if the sensor stood at "
      "each, {} "
      "turns, {} with one\n| effect | is named | "
      "sequences | named | after at most | turns with another name |\n|---|---|---|---|---|---|\n",
      method, json.at("turns").get<std::uint64_t>(), json.at("alarms").get<std::uint64_t>(),
      json.at("standing_turns").get<std::uint64_t>(),
      json.at("standing_alarms").get<std::uint64_t>());
  for (const Json& effect : json.at("effects")) {
    text += fmt::format(
        "| {} | {} | {} | {} | {} turns | {} |\n", effect.at("effect").get<std::string>(),
        effect.at("cause").get<std::string>(), effect.at("sequences").get<std::uint64_t>(),
        effect.at("named").get<std::uint64_t>(), effect.at("most_turns").get<int>(),
        effect.at("wrong_turns").get<std::uint64_t>());
  }
  return text;
}

}  // namespace terracut::sight_measures
