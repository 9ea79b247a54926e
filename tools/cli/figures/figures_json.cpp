// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "figures_json.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <string_view>
#include <variant>

#include "pipeline/status/figures.hpp"
#include "rt/measure/milliseconds.hpp"

namespace terracut::cli {
namespace {

using Json = nlohmann::ordered_json;
using measure::milliseconds;

Json json_of(const status::Value& value) {
  return std::visit(
      status::EachKind{
          [](status::NotKnown) { return Json(nullptr); }, [](const auto& of) { return Json(of); },
          [](const status::Number& of) { return Json(of.value); },
          [](const status::TimeOfDay& of) { return Json(of.ns); },
          [](const status::Duration& of) { return Json(milliseconds(of.ns)); },
          [](const status::State& of) { return Json(of.names[of.index]); },
          [](status::Histogram of) {
            return Json{{"count", of->count()},
                        {"mean", milliseconds(static_cast<std::int64_t>(of->mean_ns()))},
                        {"p50", milliseconds(of->percentile_ns(50))},
                        {"p90", milliseconds(of->percentile_ns(90))},
                        {"p99", milliseconds(of->percentile_ns(99))},
                        {"p99.9", milliseconds(of->percentile_ns(99.9))},
                        {"max", milliseconds(of->max_ns())}};
          },
          []<class Each>(const status::ByName<Each>& of) {
            Json json = Json::object();
            for (const auto& [name, each] : of.each) {
              json[std::string(name)] = json_of(each);
            }
            return json;
          }},
      value);
}

/// Returns the member of `whole` for a group such as "mount.seen" or "threads.0"; `whole` itself
/// for "".
Json& group_in(Json& whole, std::string_view group) {
  if (group.empty()) return whole;
  const std::size_t dot = std::min(group.find('.'), group.size());
  const std::string name(group.substr(0, dot));
  std::size_t index = 0;
  const bool is_index =
      std::from_chars(name.data(), name.data() + name.size(), index).ec == std::errc{};
  Json& inner = is_index ? whole[index] : whole[name];
  return group_in(inner, group.substr(std::min(dot + 1, group.size())));
}

}  // namespace

void add_figures(std::span<const status::Figure> figures, Json& json) {
  for (const status::Figure& figure : figures) {
    if (figure.key.empty()) continue;
    group_in(json, figure.group)[std::string(figure.key)] = json_of(figure.value);
  }
}

Json live_summary(const status::MonitorSnapshot& figures) {
  Json json;
  add_figures(status::figures_of(figures), json);
  if (!json.contains("threads")) json["threads"] = Json::array();  // no thread runs yet
  return json;
}

}  // namespace terracut::cli
