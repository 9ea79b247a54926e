// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "player_command.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <string>

namespace terracut::cli {
namespace {

using Json = nlohmann::json;

tl::unexpected<Error> wrong(std::string message) {
  return fail(ErrorCode::kInvalidArgument, std::move(message));
}

Expected<double> number(const Json& value, const char* key, double least, double most) {
  if (value.is_number()) {
    const double found = value.get<double>();
    if (found >= least && found <= most) return found;
  }
  return wrong(fmt::format("{}: expected a number, {} to {}", key, least, most));
}

}  // namespace

Expected<PlayerCommand> parse_player_command(std::string_view json) {
  const Json parsed = Json::parse(json, nullptr, false);
  if (!parsed.is_object()) return wrong("expected an object in JSON");
  PlayerCommand command;
  for (const auto& [key, value] : parsed.items()) {
    if (key == "playing" || key == "step" || key == "loop") {
      if (!value.is_boolean()) return wrong(key + ": expected true or false");
      if (key == "playing") command.playing = value.get<bool>();
      if (key == "loop") command.loop = value.get<bool>();
      if (key == "step") command.step = value.get<bool>();
    } else if (key == "seek_s" || key == "rate") {
      const bool is_rate = key == "rate";
      const auto found = number(value, key.c_str(), is_rate ? kLeastRate : 0,
                                is_rate ? kMostRate : kLongestSeek_s);
      if (!found) return tl::unexpected(found.error());
      (is_rate ? command.rate : command.seek_s) = *found;
    } else {
      return wrong("expected playing, step, seek_s, rate or loop, found '" + key.substr(0, 40) +
                   "'");
    }
  }
  return command;
}

}  // namespace terracut::cli
