// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sensor_choice.hpp"

#include <fmt/format.h>

#include <string_view>

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
  firmware_io::SensorProbe probe;
  for (std::uint64_t i = 0; i < kDatagramsToProbe; ++i) {
    const auto next = source.next();
    if (!next || !*next) break;
    probe.add((*next)->payload);
  }
  std::optional<SensorModel> chosen;
  for (const NamedSensor& sensor : kSensors) {
    const bool wanted = options.sensor == "auto" || options.sensor == sensor.option;
    if (!wanted || probe.packets_of(sensor.model) == 0) continue;
    if (chosen) {
      return fail(
          ErrorCode::kInvalidArgument,
          fmt::format("{}: there are packets of a {} and of a {}; choose one with --sensor, "
                      "--port or --from",
                      source.name(), to_string(*chosen), to_string(sensor.model)));
    }
    chosen = sensor.model;
  }
  if (!chosen) {
    std::string expected = "an HDL-64E (S2, S2.1, S3) or an RS-Ruby128";
    for (const NamedSensor& sensor : kSensors) {
      if (options.sensor == sensor.option) expected = fmt::format("a {}", to_string(sensor.model));
    }
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: expected data packets of {}, found none: {}", source.name(),
                            expected, found_instead(probe, source)));
  }
  SensorChoice choice;
  choice.model = *chosen;
  choice.columns = options.columns.value_or(probe.columns(*chosen));
  choice.spin_hz = probe.spin_hz(*chosen);
  choice.dual_return = probe.dual_return(*chosen);
  return choice;
}

}  // namespace terracut::cli
