// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "stream_choice.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <optional>
#include <set>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/streams/stream_text.hpp"
#include "words.hpp"

namespace terracut::cli {
namespace {

using streams::SensorStream;

/// The marks that distinguish sensors, preferred ones first.
enum class Mark : unsigned { kAddress, kPort, kTo, kVlan, kModel, kSourcePort, kMac, kCount };
constexpr unsigned kMarks = static_cast<unsigned>(Mark::kCount);

/// A set of marks as bits.
using Marks = unsigned;
constexpr bool has(Marks marks, Mark mark) {
  return (marks >> static_cast<unsigned>(mark) & 1U) != 0;
}

std::array<std::uint64_t, kMarks> values_of(const SensorStream& sensor) {
  const streams::Destination& to = sensor.destinations.front();
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

/// Returns the smallest set of marks that distinguishes all sensors.
Marks telling_marks(std::span<const SensorStream> sensors) {
  constexpr Marks kAll = (1U << kMarks) - 1;
  Marks best = kAll;
  for (Marks marks = kAll; marks > 0; --marks) {
    if (std::popcount(marks) <= std::popcount(best) && tell_apart(marks, sensors)) best = marks;
  }
  return best;
}

StreamName name_of(const SensorStream& sensor, Marks marks) {
  const streams::Destination& to = sensor.destinations.front();
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
      " of link-layer address " + streams::mac_text(sensor.source_mac.value_or(0)),
      "--mac " + streams::mac_text(sensor.source_mac.value_or(0)));
  add(has(marks, Mark::kTo), " to " + net::ipv4_text(to.address),
      "--to " + net::ipv4_text(to.address));
  add(has(marks, Mark::kPort), fmt::format(" to port {}", to.port),
      fmt::format("--port {}", to.port));
  add(has(marks, Mark::kVlan),
      to.vlan == 0 ? " in no VLAN" : " in VLAN " + streams::vlan_text(to.vlan),
      "--vlan " + streams::vlan_text(to.vlan));
  add(has(marks, Mark::kModel), "",
      fmt::format("--sensor {}",
                  sensor::row_of(sensor::model_of(sensor::sensor_of(sensor.model))).word));
  return text;
}

}  // namespace

std::vector<StreamName> names_of(std::span<const SensorStream> sensors) {
  const Marks marks = telling_marks(sensors);
  std::vector<StreamName> names;
  for (const SensorStream& sensor : sensors) names.push_back(name_of(sensor, marks));
  return names;
}

std::string choice_text(std::span<const SensorStream> sensors) {
  std::string list, choice;
  for (const StreamName& each : names_of(sensors)) {
    list += (list.empty() ? "" : ", ") + each.name;
    choice += (choice.empty() ? "" : " or ") + each.options;
  }
  return fmt::format("{}; choose one with {}", list, choice);
}

capture::PcapFilter filter_of(const CaptureOptions& options) {
  capture::PcapFilter filter{.port = options.port};
  if (const auto from = net::parse_ipv4_sender(options.from)) {
    filter.source_address = from->address;
    filter.source_port = from->port;
  }
  if (const auto to = net::parse_ipv4_address(options.to)) filter.destination_address = *to;
  if (const auto vlan = streams::parse_vlan(options.vlan)) filter.vlan = *vlan;
  if (const auto mac = streams::parse_mac(options.mac)) filter.source_mac = *mac;
  return filter;
}

}  // namespace terracut::cli
