// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sensor_choice.hpp"

#include <fmt/format.h>

#include <string_view>
#include <vector>

#include "calib/ouster/ouster_metadata.hpp"
#include "firmware_io/sensor/unknown_packets.hpp"
#include "firmware_io/streams/heard_senders.hpp"
#include "firmware_io/streams/stream_names.hpp"
#include "pipeline/status/figure_lines.hpp"
#include "pipeline/status/loss_causes.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {
namespace {

/// Describes what was found instead of packets of the wanted sensors.
std::string found_instead(const CaptureOptions& options, const streams::HeardSenders& senders,
                          const capture::CaptureSource& source) {
  std::string others = senders.others();
  if (others.empty()) return why_nothing_came(source.counters(), 0, 0, {});
  if (options.sensor) return others;
  return fmt::format("{}. {}", others, sensor::kWhatInstead);
}

/// Explains why no datagram came from a capture that has frames.
std::string where_frames_went(const capture::CaptureCounters& read) {
  std::string text = fmt::format("of {} captured frames", read.frames);
  const auto add = [&](std::uint64_t count, std::string_view what) {
    if (count > 0)
      text += fmt::format("{} {} {}", text.ends_with("frames") ? "" : ",", count, what);
  };
  add(read.other_port, "went to another port than --port");
  add(read.other_source, "came from another address than --from");
  add(read.other_stream, "are of another port of --from, or not of --to, --vlan or --mac");
  for (std::size_t i = 0; i < packet::kFrameRejects; ++i) {
    add(read.refused[i], packet::description_of(static_cast<packet::FrameReject>(i)));
  }
  return text + "; `terracut info` lists the streams";
}

}  // namespace

std::string why_nothing_came(const capture::CaptureCounters& read, std::uint64_t offered,
                             std::uint64_t empty, const frame::LossCounters& losses) {
  if (read.frames == 0) return "the capture holds no packets";
  if (read.delivered == 0) return where_frames_went(read);
  if (offered == 0) return "it ends before --start; `terracut info` tells how long it is";
  if (empty > 0) {
    return fmt::format(
        "{} data packets were decoded, and none holds a return: is the sensor covered, its window "
        "wet, its laser off, or nothing within its reach?",
        empty);
  }
  if (losses.rejected_total() == 0) {
    return fmt::format("{} datagrams were read and none rejected, but they do not make a frame",
                       offered);
  }
  return fmt::format(
      "{} datagrams were read, and these failed a check: {}; `terracut info` names "
      "the sensors in the capture",
      offered, status::counts_text(status::causes_of(losses)));
}

std::optional<sensor::SensorModel> named_model(const CaptureOptions& options) {
  if (options.sensor || !ouster::is_metadata_name(options.calibration)) return options.sensor;
  const auto unit = ouster::read_ouster_metadata(options.calibration);
  if (!unit) return std::nullopt;
  return ouster::model_of_rows(unit->format.rows);
}

std::vector<streams::SensorStream> sensors_in(const CaptureOptions& options,
                                              capture::CaptureSource& source) {
  return streams::hear_beginning(source, named_model(options)).senders.sensors();
}

Expected<SensorChoice> choose_sensor(const CaptureOptions& options,
                                     capture::CaptureSource& source) {
  const std::optional<sensor::SensorModel> named = named_model(options);
  const streams::HeardCapture heard = streams::hear_beginning(source, named);
  const std::vector<streams::SensorStream> sensors = heard.senders.sensors();
  if (sensors.empty() && heard.broke_off) return tl::unexpected(*heard.broke_off);
  if (sensors.empty()) {
    const std::string expected =
        named ? fmt::format("a {}", to_string(*named)) : "a Velodyne, RoboSense, Hesai or Ouster";
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: expected data packets of {}, found none: {}", source.name(),
                            expected, found_instead(options, heard.senders, source)));
  }
  if (sensors.size() > 1) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: there are packets of several sensors: {}", source.name(),
                            choice_text(sensors, streams::HeardIn::kCapture)));
  }
  SensorChoice choice{.stream = sensors.front(), .model = sensors.front().model};
  const sensor::SensorProbe& probe = heard.senders.probe(choice.stream.source_address);
  if (probe.backward_packets(choice.model) * 2 > probe.packets_of(choice.model)) {
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: the head of this {} turns backwards, as none that is read here "
                            "does: its azimuths fall within {} of {} packets. Were they turned "
                            "round by a simulator or converter?",
                            source.name(), to_string(choice.model),
                            probe.backward_packets(choice.model), probe.packets_of(choice.model)));
  }
  if (choice.stream.contradicts_itself) {
    warn(fmt::format(
        "{}: the packets contradict each other as those of several sensors do, which nothing in "
        "their headers tells apart: frames may be mixed. Record each sensor by itself",
        source.name()));
  }
  choice.columns = options.columns.value_or(probe.columns(choice.model));
  choice.spin_hz = probe.spin_hz(choice.model);
  choice.dual_return = probe.dual_return(choice.model);
  return choice;
}

void warn_of_unused(const CaptureOptions& options, sensor::SensorModel model) {
  const auto warn_of = [&](bool given, const char* option, const char* of) {
    if (!given) return;
    warn(fmt::format("{} is without effect: it is of {}, and the sensor is a {}", option, of,
                     to_string(model)));
  };
  warn_of(options.nominal_calibration && model != sensor::SensorModel::kRuby128,
          "--nominal-calibration", "an RS-Ruby128");
  warn_of(options.timestamp.has_value() && !sensor::is_robosense(model), "--timestamp",
          "a RoboSense");
}

}  // namespace terracut::cli
