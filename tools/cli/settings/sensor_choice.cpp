// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sensor_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>
#include <vector>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "pipeline/status/figure_lines.hpp"
#include "pipeline/status/loss_causes.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {
namespace {

using sensor::SensorModel;

/// Enough for a stream that begins with other packets, and to measure the spin rate: about a
/// second.
constexpr std::uint64_t kDatagramsToProbe = 6'000;

/// What there is instead of packets of the sensors that are wanted.
std::string found_instead(const sensor::SensorProbe& probe, const capture::PcapSource& source) {
  std::string others = probe.foreign_models();
  for (const SensorModel model : sensor::kDecodedModels) {
    const std::uint64_t packets = probe.packets_of(model);
    if (packets == 0) continue;
    others +=
        fmt::format("{}{} packets of a {}", others.empty() ? "" : ", ", packets, to_string(model));
  }
  if (!others.empty()) return others;
  const std::uint64_t unknown = probe.packets_of(SensorModel::kUnknown);
  if (unknown > 0) return fmt::format("{} datagrams of no sensor known here", unknown);
  return why_nothing_came(source.counters(), 0, {});
}

/// What became of the frames of a capture of which no datagram was delivered.
std::string where_frames_went(const capture::PcapCounters& read) {
  std::string text = fmt::format("of {} captured frames", read.frames);
  const auto add = [&](std::uint64_t count, std::string_view what) {
    if (count > 0)
      text += fmt::format("{} {} {}", text.ends_with("frames") ? "" : ",", count, what);
  };
  add(read.other_port, "went to another port than --port");
  add(read.other_source, "came from another address than --from");
  for (std::size_t i = 0; i < capture::kFrameRejects; ++i) {
    add(read.refused[i], to_string(static_cast<capture::FrameReject>(i)));
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
std::vector<Unit> units_among(const std::map<std::uint32_t, sensor::SensorProbe>& by_sender,
                              const CaptureOptions& options) {
  std::vector<Unit> units;
  std::uint64_t most = 0;
  for (const auto& [address, probe] : by_sender) {
    for (const SensorModel model : sensor::kDecodedModels) {
      const std::uint64_t packets = probe.packets_of(model);
      const bool wanted = sensor::is_wanted(options.sensor, model);
      if (wanted && packets > 0) units.push_back({address, model, packets});
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
                        net::ipv4_text(unit.address));
  }
  const bool one_address = units.front().address == units.back().address;
  return fail(ErrorCode::kInvalidArgument,
              fmt::format("{}: there are packets of several sensors: {}; choose one with {}", name,
                          list, one_address ? "--sensor or --port" : "--from"));
}

}  // namespace

std::string why_nothing_came(const capture::PcapCounters& read, std::uint64_t offered,
                             const frame::LossCounters& losses) {
  if (read.frames == 0) return "the capture holds no packets";
  if (read.delivered == 0) return where_frames_went(read);
  if (offered == 0) return "it ends before --start; `terracut info` tells how long it is";
  if (losses.rejected_total() == 0) {
    return fmt::format("{} datagrams were read and none rejected, but they do not make a frame",
                       offered);
  }
  return fmt::format(
      "{} datagrams were read, and these failed a check: {}; `terracut info` names "
      "the sensors in the capture",
      offered, status::counts_text(status::causes_of(losses)));
}

Expected<SensorChoice> choose_sensor(const CaptureOptions& options, capture::PcapSource& source) {
  sensor::SensorProbe all;
  std::map<std::uint32_t, sensor::SensorProbe> by_sender;
  for (std::uint64_t i = 0; i < kDatagramsToProbe; ++i) {
    const auto next = source.next();
    if (!next || !*next) break;
    all.add(**next);
    by_sender[(*next)->source_address].add(**next);
  }
  const std::vector<Unit> units = units_among(by_sender, options);
  if (units.empty()) {
    const std::string expected = options.sensor ? fmt::format("a {}", to_string(*options.sensor))
                                                : "a Velodyne or RS-Ruby128";
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: expected data packets of {}, found none: {}", source.name(),
                            expected, found_instead(all, source)));
  }
  if (units.size() > 1) return several(units, source.name());
  const Unit& unit = units.front();
  const sensor::SensorProbe& probe = by_sender.at(unit.address);
  SensorChoice choice;
  choice.address = unit.address;
  choice.model = unit.model;
  choice.columns = options.columns.value_or(probe.columns(unit.model));
  choice.spin_hz = probe.spin_hz(unit.model);
  choice.dual_return = probe.dual_return(unit.model);
  return choice;
}

void warn_of_unused(const CaptureOptions& options, sensor::SensorModel model) {
  if (model == sensor::SensorModel::kRuby128) return;
  const auto warn_of = [&](bool given, const char* option) {
    if (!given) return;
    warn(fmt::format("{} is without effect: it is of an RS-Ruby128, and the sensor is a {}", option,
                     to_string(model)));
  };
  warn_of(options.nominal_calibration, "--nominal-calibration");
  warn_of(options.timestamp.has_value(), "--timestamp");
}

}  // namespace terracut::cli
