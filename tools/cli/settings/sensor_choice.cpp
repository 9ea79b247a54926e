// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sensor_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "firmware_io/packet/sensor_recognition.hpp"
#include "firmware_io/sensor/unknown_packets.hpp"
#include "firmware_io/streams/sender_streams.hpp"
#include "pipeline/status/figure_lines.hpp"
#include "pipeline/status/loss_causes.hpp"
#include "stream_choice.hpp"
#include "tools/cli/console.hpp"

namespace terracut::cli {
namespace {

using sensor::SensorModel;

/// About a second: enough to measure the spin rate of a stream that begins with other packets.
constexpr std::uint64_t kDatagramsToProbe = 6'000;

/// Describes what was found instead of packets of the wanted sensors.
std::string found_instead(const sensor::SensorProbe& probe, const capture::PcapSource& source,
                          const std::string& first_unknown) {
  std::string others = probe.foreign_models();
  for (const SensorModel model : sensor::kDecodedModels) {
    const std::uint64_t packets = probe.packets_of(model);
    if (packets == 0) continue;
    others +=
        fmt::format("{}{} packets of a {}", others.empty() ? "" : ", ", packets, to_string(model));
  }
  if (!others.empty()) return others;
  const std::uint64_t unknown = probe.packets_of(SensorModel::kUnknown);
  if (unknown > 0) {
    return fmt::format(
        "{} datagrams of no sensor known here{}. Clouds that its own driver makes of them are "
        "labelled by `terracut segment` (files) and `terracut node` (ROS 2)",
        unknown, first_unknown.empty() ? "" : ", " + first_unknown);
  }
  return why_nothing_came(source.counters(), 0, 0, {});
}

/// Explains a capture with frames but without a delivered datagram.
std::string where_frames_went(const capture::PcapCounters& read) {
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

/// The packets heard at the beginning of a capture.
struct Heard {
  struct Sender {
    explicit Sender(const CaptureOptions& options) : probe(options.sensor) {}

    sensor::SensorProbe probe;
    std::map<SensorModel, streams::SenderStreams> streams;
  };

  sensor::SensorProbe all;
  std::map<std::uint32_t, Sender> by_address;
  std::optional<Error> broke_off;
  std::string first_unknown;  ///< "1218 bytes to port 2368: ..."; empty if none.

  Heard(const CaptureOptions& options, capture::PcapSource& source) : all(options.sensor) {
    for (std::uint64_t i = 0; i < kDatagramsToProbe; ++i) {
      const auto next = source.next();
      if (!next) broke_off = next.error();
      if (!next || !*next) break;
      all.add(**next);
      Sender& sender = by_address.try_emplace((*next)->source_address, options).first->second;
      sender.probe.add(**next);
      const SensorModel model = sensor::recognise_sensor_as(options.sensor, (*next)->payload);
      if (model == SensorModel::kUnknown && first_unknown.empty()) {
        const std::string guess = sensor::guess_of_unknown(**next);
        first_unknown = fmt::format("{} bytes to port {}{}{}", (*next)->payload.size(),
                                    (*next)->destination_port, guess.empty() ? "" : ": ", guess);
      }
      if (sensor::is_decoded(model) && sensor::is_wanted(options.sensor, model)) {
        sender.streams.try_emplace(model, model).first->second.add(**next);
      }
    }
  }

  [[nodiscard]] std::vector<streams::SensorStream> sensors() const {
    std::vector<streams::SensorStream> sensors;
    for (const auto& [address, sender] : by_address) {
      for (const auto& [model, of_model] : sender.streams) {
        std::ranges::move(of_model.sensors(), std::back_inserter(sensors));
      }
    }
    streams::drop_strays(sensors);
    return sensors;
  }
};

}  // namespace

std::string why_nothing_came(const capture::PcapCounters& read, std::uint64_t offered,
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

std::vector<streams::SensorStream> sensors_in(const CaptureOptions& options,
                                              capture::PcapSource& source) {
  return Heard(options, source).sensors();
}

Expected<SensorChoice> choose_sensor(const CaptureOptions& options, capture::PcapSource& source) {
  const Heard heard(options, source);
  const std::vector<streams::SensorStream> sensors = heard.sensors();
  if (sensors.empty() && heard.broke_off) return tl::unexpected(*heard.broke_off);
  if (sensors.empty()) {
    const std::string expected = options.sensor ? fmt::format("a {}", to_string(*options.sensor))
                                                : "a Velodyne or RS-Ruby128";
    return fail(ErrorCode::kUnsupported,
                fmt::format("{}: expected data packets of {}, found none: {}", source.name(),
                            expected, found_instead(heard.all, source, heard.first_unknown)));
  }
  if (sensors.size() > 1) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("{}: there are packets of several sensors: {}", source.name(),
                            choice_text(sensors)));
  }
  SensorChoice choice{.stream = sensors.front(), .model = sensors.front().model};
  const sensor::SensorProbe& probe = heard.by_address.at(choice.stream.source_address).probe;
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
