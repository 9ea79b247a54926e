// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "calib/hdl64e/hdl64e_stream_table.hpp"
#include "firmware_io/bag/bag.hpp"
#include "firmware_io/bag/packet_messages.hpp"
#include "firmware_io/bag/topic_choice.hpp"
#include "firmware_io/sensor/capture_survey.hpp"
#include "firmware_io/sensor/unknown_packets.hpp"
#include "firmware_io/streams/stream_names.hpp"
#include "firmware_io/streams/stream_text.hpp"
#include "pipeline/status/figures.hpp"
#include "tools/cli/commands.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/figures/device_information.hpp"
#include "tools/cli/figures/figures_json.hpp"
#include "tools/cli/json_text.hpp"
#include "tools/cli/settings/companion_files.hpp"
#include "tools/cli/settings/sensor_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

using sensor::CaptureSurvey;
using sensor::Hdl64eFacts;
using sensor::Ruby128Facts;
using sensor::SensorModel;
using sensor::StreamFacts;
using sensor::UdpStream;
using Json = nlohmann::ordered_json;

std::string endpoint(std::uint32_t address, std::uint16_t port) {
  return fmt::format("{}.{}.{}.{}:{}", address >> 24, address >> 16 & 0xFFU, address >> 8 & 0xFFU,
                     address & 0xFFU, port);
}

/// Returns the destination of a stream, including its VLAN.
std::string destination(const UdpStream& stream) {
  const std::string text = endpoint(stream.destination_address, stream.destination_port);
  return stream.vlan == 0 ? text : text + " VLAN " + streams::vlan_text(stream.vlan);
}

std::string sizes(const UdpStream& stream) {
  std::string text;
  for (const auto& [bytes, count] : stream.payload_sizes) {
    if (text.size() > 40) return text + ", ...";
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", bytes,
                        stream.payload_sizes.size() > 1 ? fmt::format(" ({}x)", count) : "");
  }
  return text;
}

double duration_s(const UdpStream& stream) {
  return static_cast<double>(stream.last_stamp_ns - stream.first_stamp_ns) * 1e-9;
}

std::string utc(std::int64_t stamp_ns) {
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC",
                     fmt::gmtime(static_cast<std::time_t>(stamp_ns / 1'000'000'000)));
}

/// Describes the table in the packets: "complete, fingerprint ...", or what is missing.
std::string calibration_in(const Hdl64eFacts& facts) {
  if (!facts.table) {
    return fmt::format("incomplete, {} of {} bytes missing", facts.status_holes,
                       hdl64e::kStreamTableBytes);
  }
  const auto table = hdl64e::parse_stream_table(*facts.table);
  if (!table) return "unusable: " + table.error().message;
  return fmt::format("complete, fingerprint {:016x}", fingerprint(*table));
}

std::string text_of(const StreamFacts& facts) {
  const std::string period = facts.packet_period_us > 0
                                 ? fmt::format("a packet every {:.1f} us", facts.packet_period_us)
                                 : "too few packets to tell their period";
  std::string text = fmt::format(
      "  head         {:.1f} rpm{}, {:.1f} frames, {:.4f} deg a column\n"
      "  mode         {} return, {}\n"
      "  lost         {} packets by stamps and azimuths; {} repeated, {} out of order, {} clock "
      "jumps\n",
      facts.spin_rpm, facts.spin_rpm < 0 ? " (backwards, as no sensor that is read turns)" : "",
      facts.frames, facts.step_deg, to_string(facts.return_mode), period, facts.packets_lost,
      facts.packets_repeated, facts.packets_reordered, facts.clock_jumps);
  if (!facts.blind.is_none()) {
    text +=
        fmt::format("  blind        from {:.1f} to {:.1f} deg of the head; its time is no loss\n",
                    facts.blind.from_cdeg * 0.01, facts.blind.to_cdeg * 0.01);
  }
  if (facts.azimuths_out_of_range > 0) {
    text += fmt::format("  broken       {} packets with an azimuth of 360 degrees or more\n",
                        facts.azimuths_out_of_range);
  }
  return text;
}

std::string text_of(const Hdl64eFacts& facts) {
  std::string text = text_of(static_cast<const StreamFacts&>(facts));
  text += fmt::format("  calibration  {}\n", calibration_in(facts));
  if (facts.status.temperature_deg_c) {
    text += fmt::format("  temperature  {} deg C\n", int{*facts.status.temperature_deg_c});
  }
  if (facts.status.firmware) {
    text += fmt::format("  firmware     {:#04x}\n", unsigned{*facts.status.firmware});
  }
  if (facts.status.warning_bits && *facts.status.warning_bits != 0) {
    text += fmt::format("  warnings     bits {:#04x} (1 lens dirty, 2 hot, 4 cold)\n",
                        unsigned{*facts.status.warning_bits});
  }
  return text;
}

std::string text_of(const Ruby128Facts& facts) {
  return text_of(static_cast<const StreamFacts&>(facts)) +
         fmt::format(
             "  clock        {} ({}), {:.1f} s {} the capture; protocol version {}\n"
             "  temperature  {:.1f} deg C\n",
             to_string(facts.timestamp), facts.timestamp_proven ? "proven" : "most likely",
             std::abs(facts.ahead_of_capture_s),
             facts.ahead_of_capture_s < 0 ? "behind" : "ahead of", facts.protocol_version,
             facts.temperature_deg_c);
}

/// Returns the RoboSense that a capture's DIFOP packets are of: they do not say it.
SensorModel robosense_in(const CaptureSurvey& survey) {
  const auto found = std::ranges::find_if(survey.streams, sensor::is_robosense, &UdpStream::sensor);
  return found == survey.streams.end() ? SensorModel::kRuby128 : found->sensor;
}

std::string text_of(const CaptureSurvey& survey) {
  std::string text = fmt::format("{}: {} frames of {}\n", survey.name, survey.counters.frames,
                                 survey.link_type_name);
  for (std::size_t i = 0; i < packet::kFrameRejects; ++i) {
    if (survey.counters.refused[i] == 0) continue;
    text += fmt::format("  {} {}\n", survey.counters.refused[i],
                        packet::description_of(static_cast<packet::FrameReject>(i)));
  }
  std::size_t width = 22;
  for (const UdpStream& stream : survey.streams) {
    width = std::max(width, destination(stream).size());
  }
  text += fmt::format("\n{:<22} {:<{}} {:>9} {:>10} {:>8}  {:<18} {}\n", "source", "destination",
                      width, "packets", "packets/s", "seconds", "payload bytes", "sensor");
  for (const UdpStream& stream : survey.streams) {
    text += fmt::format("{:<22} {:<{}} {:>9} {:>10.1f} {:>8.1f}  {:<18} {}{}\n",
                        endpoint(stream.source_address, stream.source_port), destination(stream),
                        width, stream.packets, stream.rate_hz(), duration_s(stream), sizes(stream),
                        to_string(stream.sensor),
                        stream.sensor_hints.empty() ? "" : " (" + stream.sensor_hints + ")");
  }
  if (survey.packets_of_further_streams > 0) {
    text += fmt::format("{} packets of further streams\n", survey.packets_of_further_streams);
  }
  for (const UdpStream& stream : survey.streams) {
    const auto describe = [&](std::string_view what, const std::string& facts) {
      text += fmt::format("\n{} at {}, from {}\n{}", what,
                          endpoint(stream.source_address, stream.source_port),
                          utc(stream.first_stamp_ns), facts);
    };
    if (stream.hdl64e) describe("HDL-64E", text_of(*stream.hdl64e));
    if (stream.ruby128) describe("RS-Ruby128", text_of(*stream.ruby128));
    if (stream.head) describe(to_string(stream.sensor), text_of(*stream.head));
    if (stream.device) {
      const SensorModel model = robosense_in(survey);
      describe(fmt::format("{} device information", to_string(model)),
               device_text(*stream.device, model));
    }
  }
  // Of a LiDAR, by its packets or by what they look like.
  const auto is_not_read = [](const UdpStream& stream) {
    return !sensor::is_decoded(stream.sensor) && !stream.sensor_hints.empty();
  };
  if (std::ranges::any_of(survey.streams, is_not_read)) {
    text += fmt::format("\nPackets that are not read: {}\n", sensor::kWhatInstead);
  }
  return text;
}

Json json_of(const StreamFacts& facts) {
  Json json{{"packets", facts.packets},
            {"return_mode", to_string(facts.return_mode)},
            {"packet_period_us", facts.packet_period_us},
            {"spin_rpm", facts.spin_rpm},
            {"step_deg", facts.step_deg},
            {"frames", facts.frames},
            {"packets_lost", facts.packets_lost},
            {"packets_repeated", facts.packets_repeated},
            {"packets_reordered", facts.packets_reordered},
            {"clock_jumps", facts.clock_jumps},
            {"azimuths_out_of_range", facts.azimuths_out_of_range}};
  add_figures(status::figures_of(facts.blind), json);
  return json;
}

Json json_of(const Ruby128Facts& facts) {
  Json json = json_of(static_cast<const StreamFacts&>(facts));
  json["protocol_version"] = facts.protocol_version;
  json["timestamp"] = to_string(facts.timestamp);
  json["timestamp_proven"] = facts.timestamp_proven;
  json["ahead_of_capture_s"] = facts.ahead_of_capture_s;
  json["temperature_deg_c"] = facts.temperature_deg_c;
  return json;
}

Json json_of(const Hdl64eFacts& facts) {
  Json json = json_of(static_cast<const StreamFacts&>(facts));
  json["calibration"] = calibration_in(facts);
  if (facts.status.temperature_deg_c) json["temperature_deg_c"] = *facts.status.temperature_deg_c;
  if (facts.status.firmware) json["firmware"] = *facts.status.firmware;
  if (facts.status.warning_bits) json["warning_bits"] = *facts.status.warning_bits;
  return json;
}

Json json_of(const std::vector<bag::Topic>& topics) {
  Json json = Json::array();
  for (const bag::Topic& topic : topics)
    json.push_back({{"name", topic.name}, {"type", topic.type}});
  return json;
}

Json json_of(const CaptureSurvey& survey) {
  Json json{{"terracut", TERRACUT_VERSION},
            {"command", "info"},
            {"input", survey.name},
            {"link_type", survey.link_type_name},
            {"frames", survey.counters.frames}};
  for (std::size_t i = 0; i < packet::kFrameRejects; ++i) {
    json["refused"][std::string(to_string(static_cast<packet::FrameReject>(i)))] =
        survey.counters.refused[i];
  }
  Json& streams = json["streams"] = Json::array();
  for (const UdpStream& stream : survey.streams) {
    Json& entry = streams.emplace_back(
        Json{{"source", endpoint(stream.source_address, stream.source_port)},
             {"destination", endpoint(stream.destination_address, stream.destination_port)},
             {"packets", stream.packets},
             {"payload_bytes", stream.payload_bytes},
             {"packets_per_s", stream.rate_hz()},
             {"first_stamp_ns", stream.first_stamp_ns},
             {"last_stamp_ns", stream.last_stamp_ns},
             {"sensor", to_string(stream.sensor)},
             {"hints", stream.sensor_hints}});
    if (stream.vlan != 0) entry["vlan"] = streams::vlan_text(stream.vlan);
    if (stream.hdl64e) entry["hdl64e"] = json_of(*stream.hdl64e);
    if (stream.ruby128) entry["ruby128"] = json_of(*stream.ruby128);
    if (stream.head) entry["head"] = json_of(*stream.head);
    if (stream.device) entry["device"] = device_json(*stream.device, robosense_in(survey));
  }
  if (survey.broke_off) json["broke_off"] = survey.broke_off->message;
  return json;
}

/// Lists how to choose each of the sensors.
std::string text_of(const std::vector<streams::StreamName>& sensors) {
  if (sensors.empty()) return {};
  std::string text = "\nseveral sensors; choose one:\n";
  for (const streams::StreamName& sensor : sensors) {
    text += fmt::format("  {:<24} {}\n", sensor.options, sensor.name);
  }
  return text;
}

/// Returns the sensors of a capture if there are several.
std::vector<streams::StreamName> several_sensors_of(const CaptureOptions& options) {
  auto source = capture::CaptureSource::open(options.file, {.topic = options.topic});
  if (!source) return {};
  const auto sensors = sensors_in(options, *source);
  return sensors.size() < 2 ? std::vector<streams::StreamName>()
                            : names_of(sensors, streams::HeardIn::kCapture);
}

/// Returns a note if a calibration lies beside the capture and its packets hold none.
std::string note_of_calibration(const CaptureSurvey& survey, const CaptureOptions& options) {
  const auto lacks_one = [](const UdpStream& stream) {
    return stream.hdl64e && !stream.hdl64e->table;
  };
  const auto beside = calibration_beside(options.file);
  if (std::ranges::none_of(survey.streams, lacks_one) || !beside || beside->empty()) return {};
  return fmt::format("\n{} beside the capture is taken where the packets hold no calibration\n",
                     beside->string());
}

/// Lists the topics of a bag; empty for a capture.
std::string text_of(const std::vector<bag::Topic>& topics) {
  std::string text;
  for (const bag::Topic& topic : topics) {
    text += fmt::format("  {:<32} {}{}\n", topic.name, topic.type,
                        bag::holds_packets(topic.type)  ? " (packets)"
                        : bag::holds_clouds(topic.type) ? " (clouds)"
                                                        : "");
  }
  return text.empty() ? text : "topics\n" + text + "\n";
}

/// Shows a bag without a topic whose packets could be surveyed.
ExitCode show_topics(const Options& options, const std::vector<bag::Topic>& topics) {
  print_text(text_of(topics));
  Json json{{"terracut", TERRACUT_VERSION},
            {"command", "info"},
            {"input", options.capture.file.string()},
            {"topics", json_of(topics)}};
  return done_or_refused(write_json(options.output.json, json));
}

}  // namespace

ExitCode run_info(const Options& options) {
  catch_stop_signals();
  std::vector<bag::Topic> topics;
  if (bag::is_bag(options.capture.file)) {
    const auto bag = bag::Bag::open(options.capture.file);
    if (!bag) return refuse(bag.error());
    topics = bag->topics();
    const auto has_packets = [](const bag::Topic& topic) { return bag::holds_packets(topic.type); };
    if (options.capture.topic.empty() && std::ranges::count_if(topics, has_packets) != 1) {
      return show_topics(options, topics);
    }
  }
  auto source =
      capture::CaptureSource::open(options.capture.file, {.topic = options.capture.topic});
  if (!source) return refuse(source.error());
  const CaptureSurvey survey = sensor::survey_capture(*source, stop_wanted);
  if (const Status whole = go_on(); !whole) return refuse_work(whole.error());
  const std::vector<streams::StreamName> several = several_sensors_of(options.capture);
  print_text(text_of(topics) + text_of(survey) + note_of_calibration(survey, options.capture) +
             text_of(several));
  Json json = json_of(survey);
  if (!topics.empty()) json["topics"] = json_of(topics);
  for (const streams::StreamName& sensor : several) {
    json["several_sensors"].push_back({{"name", sensor.name}, {"options", sensor.options}});
  }
  if (const Status written = write_json(options.output.json, json); !written) {
    return refuse(written.error());
  }
  if (!survey.broke_off) return kOk;
  if (survey.counters.frames == 0) return refuse(*survey.broke_off);
  warn(survey.broke_off->message);
  return kOk;
}

}  // namespace terracut::cli
