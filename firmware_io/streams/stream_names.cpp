// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/streams/stream_names.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <set>
#include <string_view>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/streams/stream_text.hpp"

namespace terracut::streams {
namespace {

/// The properties that can tell sensors apart; earlier ones are preferred to later ones.
enum class Mark : unsigned { kAddress, kPort, kTo, kVlan, kModel, kSourcePort, kMac, kCount };
constexpr unsigned kMarks = static_cast<unsigned>(Mark::kCount);

/// A set of marks: bit i stands for the mark with number i.
using Marks = unsigned;
constexpr Marks kAll = (1U << kMarks) - 1;
constexpr Marks set_of(std::initializer_list<Mark> marks) {
  Marks set = 0;
  for (const Mark mark : marks) set |= 1U << static_cast<unsigned>(mark);
  return set;
}
/// The marks that the options of the command `live` can state; `live` opens a single port.
constexpr Marks kOfLive = set_of({Mark::kAddress, Mark::kTo, Mark::kModel, Mark::kSourcePort});
constexpr bool has(Marks marks, Mark mark) {
  return (marks >> static_cast<unsigned>(mark) & 1U) != 0;
}

std::array<std::uint64_t, kMarks> values_of(const SensorStream& sensor) {
  const Destination& to = sensor.destinations.front();
  return {sensor.source_address,
          to.port,
          to.address,
          to.vlan,
          static_cast<std::uint64_t>(sensor.model),
          sensor.source_port.value_or(0),
          sensor.source_mac.value_or(0)};
}

bool tell_apart(Marks marks, std::span<const SensorStream> sensors) {
  std::set<std::array<std::uint64_t, kMarks>> seen;
  for (const SensorStream& sensor : sensors) {
    auto values = values_of(sensor);
    for (unsigned i = 0; i < kMarks; ++i) {
      if (!has(marks, static_cast<Mark>(i))) values[i] = 0;
    }
    if (!seen.insert(values).second) return false;
  }
  return true;
}

/// Returns the smallest subset of `all` that distinguishes the sensors; `all` if no subset does.
Marks telling_marks(Marks all, std::span<const SensorStream> sensors) {
  Marks best = all;
  for (Marks marks = all; marks > 0; marks = (marks - 1) & all) {
    if (std::popcount(marks) <= std::popcount(best) && tell_apart(marks, sensors)) best = marks;
  }
  return best;
}

StreamName name_of(const SensorStream& sensor, Marks marks, HeardIn heard_in) {
  const Destination& to = sensor.destinations.front();
  const std::string from = net::ipv4_text(sensor.source_address);
  StreamName text{.name = fmt::format("{} at {}", to_string(sensor.model), from), .options = {}};
  const auto add = [&](bool is_told, std::string_view name, const std::string& option) {
    if (!is_told) return;
    text.name += name;
    text.options += (text.options.empty() ? "" : " ") + option;
  };
  const bool by_source_port = has(marks, Mark::kSourcePort) && sensor.source_port;
  add(has(marks, Mark::kAddress) && !by_source_port, "", "--from " + from);
  add(by_source_port, fmt::format(" from port {}", sensor.source_port.value_or(0)),
      fmt::format("--from {}:{}", from, sensor.source_port.value_or(0)));
  add(has(marks, Mark::kMac) && sensor.source_mac,
      " of link-layer address " + mac_text(sensor.source_mac.value_or(0)),
      "--mac " + mac_text(sensor.source_mac.value_or(0)));
  add(has(marks, Mark::kTo), " to " + net::ipv4_text(to.address),
      heard_in == HeardIn::kLiveRun
          ? fmt::format("--listen {}:{}", net::ipv4_text(to.address), to.port)
          : "--to " + net::ipv4_text(to.address));
  add(has(marks, Mark::kPort), fmt::format(" to port {}", to.port),
      fmt::format("--port {}", to.port));
  add(has(marks, Mark::kVlan), to.vlan == 0 ? " in no VLAN" : " in VLAN " + vlan_text(to.vlan),
      "--vlan " + vlan_text(to.vlan));
  add(has(marks, Mark::kModel), "",
      fmt::format("--sensor {}",
                  sensor::row_of(sensor::model_of(sensor::sensor_of(sensor.model))).word));
  return text;
}

}  // namespace

std::vector<StreamName> names_of(std::span<const SensorStream> sensors, HeardIn heard_in) {
  const Marks marks = telling_marks(heard_in == HeardIn::kLiveRun ? kOfLive : kAll, sensors);
  std::vector<StreamName> names;
  for (const SensorStream& sensor : sensors) names.push_back(name_of(sensor, marks, heard_in));
  return names;
}

std::string choice_text(std::span<const SensorStream> sensors, HeardIn heard_in) {
  std::string list, choice;
  for (const StreamName& each : names_of(sensors, heard_in)) {
    list += (list.empty() ? "" : ", ") + each.name;
    choice += (choice.empty() ? "" : " or ") + each.options;
  }
  return fmt::format("{}; choose one with {}", list, choice);
}

}  // namespace terracut::streams
