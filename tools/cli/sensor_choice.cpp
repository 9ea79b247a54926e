// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sensor_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include "firmware_io/live/ipv4_endpoint.hpp"

#include "loss_table.hpp"

namespace terracut::cli {
namespace {

using firmware_io::SensorModel;

/// Enough for a stream that begins with other packets, and to measure the spin rate: about a
/// second.
constexpr std::uint64_t kDatagramsToProbe = 6'000;

struct NamedSensor {
  std::string_view option;
  SensorModel model;
};
constexpr NamedSensor kSensors[] = {{"hdl64e", SensorModel::kHdl64e},
                                    {"ruby128", SensorModel::kRuby128}};

/// What there is instead of packets of the sensors that can be decoded.
std::string found_instead(const firmware_io::SensorProbe& probe,
                          const firmware_io::PcapSource& source) {
  const std::string foreign = probe.foreign_models();
  if (!foreign.empty()) return foreign;
  const std::uint64_t unknown = probe.packets_of(SensorModel::kUnknown);
  if (unknown > 0) return fmt::format("{} datagrams of no sensor known here", unknown);
  return why_nothing_came(source.counters(), 0, {});
}

/// What became of the frames of a capture of which no datagram was delivered.
std::string where_frames_went(const firmware_io::PcapCounters& read) {
  std::string text = fmt::format("of {} captured frames", read.frames);
  const auto add = [&](std::uint64_t count, std::string_view what) {
    if (count > 0)
      text += fmt::format("{} {} {}", text.ends_with("frames") ? "" : ",", count, what);
  };
  add(read.other_port, "went to another port than --port");
  add(read.other_source, "came from another address than --from");
  for (std::size_t i = 0; i < firmware_io::kFrameRejects; ++i) {
    add(read.refused[i], to_string(static_cast<firmware_io::FrameReject>(i)));
  }
  return text + "; `terracut info` lists the streams";
}

/// A sensor of the capture.
struct Unit {
  std::uint32_t address;
  SensorModel model;
  std::uint64_t packets;
};

/// Those of the wanted models, without who sent but stray packets of them.
std::vector<Unit> units_among(const std::map<std::uint32_t, firmware_io::SensorProbe>& by_sender,
                              const CaptureOptions& options) {
  std::vector<Unit> units;
  std::uint64_t most = 0;
  for (const auto& [address, probe] : by_sender) {
    for (const NamedSensor& sensor : kSensors) {
      const std::uint64_t packets = probe.packets_of(sensor.model);
      const bool wanted = options.sensor == "auto" || options.sensor == sensor.option;
      if (wanted && packets > 0) units.push_back({address, sensor.model, packets});
    }
  }
  for (const Unit& unit : units) most = std::max(most, unit.packets);
  constexpr std::uint64_t kStrayShare = 100;
  std::erase_if(units, [&](const Unit& unit) { return unit.packets * kStrayShare < most; });
  return units;
}

tl::unexpected<Error> several(const std::vector<Unit>& units, const std::string& name) {
  std::string list;
  for (const Unit& unit : units) {
    list += fmt::format("{}{} at {}", list.empty() ? "" : ", ", to_string(unit.model),
                        firmware_io::ipv4_text(unit.address));
  }
  const bool one_address = units.front().address == units.back().address;
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("{}: there are packets of several sensors: {}; choose one with {}", name,
                          list, one_address ? "--sensor or --port" : "--from"));
}

}  // namespace

std::string why_nothing_came(const firmware_io::PcapCounters& read, std::uint64_t offered,
                             const firmware_io::LossCounters& losses) {
  if (read.frames == 0) return "the capture holds no packets";
  if (read.delivered == 0) return where_frames_went(read);
  if (offered == 0) return "it ends before --start; `terracut info` tells how long it is";
  if (losses.rejected_total() == 0) {
    return fmt::format("{} datagrams were read and none rejected, but they do not make a turn",
                       offered);
  }
  return fmt::format(
      "{} datagrams were read, and these failed a check: {}; `terracut info` names "
      "the sensors in the capture",
      offered, loss_sentence(losses));
}

Expected<SensorChoice> choose_sensor(const CaptureOptions& options,
                                     firmware_io::PcapSource& source) {
  firmware_io::SensorProbe all;
  std::map<std::uint32_t, firmware_io::SensorProbe> by_sender;
  for (std::uint64_t i = 0; i < kDatagramsToProbe; ++i) {
    const auto next = source.next();
    if (!next || !*next) break;
    all.add((*next)->payload);
    by_sender[(*next)->source_address].add((*next)->payload);
  }
  const std::vector<Unit> units = units_among(by_sender, options);
  if (units.empty()) {
    std::string expected = "an HDL-64E (S2, S2.1, S3) or an RS-Ruby128";
    for (const NamedSensor& sensor : kSensors) {
      if (options.sensor == sensor.option) expected = fmt::format("a {}", to_string(sensor.model));
    }
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: expected data packets of {}, found none: {}", source.name(),
                            expected, found_instead(all, source)));
  }
  if (units.size() > 1) return several(units, source.name());
  const Unit& unit = units.front();
  const firmware_io::SensorProbe& probe = by_sender.at(unit.address);
  SensorChoice choice;
  choice.address = unit.address;
  choice.model = unit.model;
  choice.columns = options.columns.value_or(probe.columns(unit.model));
  choice.spin_hz = probe.spin_hz(unit.model);
  choice.dual_return = probe.dual_return(unit.model);
  return choice;
}

}  // namespace terracut::cli
