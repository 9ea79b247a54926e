// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/streams/first_seconds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "calib/hdl64e/hdl64e_stream_table.hpp"
#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/sensor/unknown_packets.hpp"
#include "firmware_io/streams/stream_names.hpp"

namespace terracut::streams {
namespace {

/// Any other sensor at the same port has sent a packet within this time after the first sensor's.
constexpr std::int64_t kAnotherShows_ns = 300'000'000;
/// A rotating sensor sends its calibration within this time, if at all; an HDL-64E takes 1.2 s.
constexpr std::int64_t kCalibrationComes_ns = 6'000'000'000;

bool is_sent_by(const net::Sender& sender, const SensorStream& sensor) {
  return sensor.source_address == sender.address &&
         (!sender.port || sensor.source_port == sender.port);
}

}  // namespace

bool FirstSeconds::wants_device_port() const {
  return std::ranges::any_of(sensor::kDecodedModels,
                             [this](sensor::SensorModel model) {
                               return sensor::is_robosense(model) && senders_.wants(model);
                             }) &&
         !config_.calibration.is_given() && config_.device_port != 0;
}

bool FirstSeconds::is_enough() const {
  const Sensors sensors = chosen_of(senders_.rotating());
  if (sensors.empty() || senders_.known_for_ns() < kAnotherShows_ns) return false;
  if (config_.known && senders_.is_steady_but_stands(config_.known->address)) return false;
  return sensors.size() > 1 || config_.calibration.is_given() ||
         senders_.has_told(sensors.front()) || senders_.known_for_ns() >= kCalibrationComes_ns;
}

std::string FirstSeconds::waits_for() const {
  const bool known_stands = config_.known && senders_.is_steady_but_stands(config_.known->address);
  if (const Sensors sensors = chosen_of(senders_.rotating()); !sensors.empty() && !known_stands) {
    return fmt::format("{} at {} is heard; waiting for its calibration",
                       to_string(sensors.front().model),
                       net::ipv4_text(sensors.front().source_address));
  }
  const std::string heard = heard_instead();
  return fmt::format("waiting for {} at {}{}", wanted_name(), config_.place,
                     heard.empty() ? "" : ": " + heard);
}

Expected<SensorOnAir> FirstSeconds::conclude(std::optional<double> patience_s) const {
  Sensors found = chosen_of(senders_.rotating());
  if (found.empty()) found = chosen_of(senders_.steady());
  if (found.empty()) return tl::unexpected(nobody(patience_s));
  if (found.size() > 1) {
    return fail(ErrorCode::kInvalidArgument,
                "several sensors send here: " + choice_text(found, HeardIn::kLiveRun));
  }
  const SensorStream& sensor = found.front();
  const sensor::SensorProbe& probe = senders_.probe(sensor.source_address);
  auto calibration = sensor::unit_calibration(config_.calibration, sensor.model, [&] {
    return from_packets(sensor.model, sensor.source_address);
  });
  if (!calibration) return tl::unexpected(calibration.error());
  const auto rotation = calib::rotation_of(*calibration);
  return SensorOnAir{.sender = {sensor.source_address, sensor.source_port},
                     .model = sensor.model,
                     .columns = config_.columns.value_or(rotation ? rotation->columns
                                                                  : probe.columns(sensor.model)),
                     .spin_hz = rotation ? rotation->spin_hz : probe.spin_hz(sensor.model),
                     .dual_return = probe.dual_return(sensor.model),
                     .calibration = *std::move(calibration)};
}

FirstSeconds::Sensors FirstSeconds::chosen_of(Sensors heard) const {
  if (heard.size() < 2 || !config_.known) return heard;
  Sensors known;
  std::ranges::copy_if(heard, std::back_inserter(known), [&](const SensorStream& sensor) {
    return is_sent_by(*config_.known, sensor);
  });
  return known.size() == 1 ? known : heard;
}

std::string FirstSeconds::other_sensors() const {
  const Sensors heard = senders_.rotating(), chosen = chosen_of(heard);
  const std::vector<StreamName> names = names_of(heard, HeardIn::kLiveRun);
  std::string others;
  for (std::size_t i = 0; i < heard.size(); ++i) {
    const bool is_chosen = chosen.size() == 1 &&
                           heard[i].source_address == chosen.front().source_address &&
                           heard[i].source_port == chosen.front().source_port;
    if (!is_chosen) others += (others.empty() ? "" : ", ") + names[i].name;
  }
  return others;
}

std::string FirstSeconds::wanted_name() const {
  return config_.model ? std::string(to_string(*config_.model))
                       : "a Velodyne, RoboSense, Hesai or Ouster";
}

std::string FirstSeconds::heard_instead() const {
  std::string heard = senders_.others();
  if (heard.empty() && foreign_ > 0) {
    heard = fmt::format("{} datagrams from other addresses than --from", foreign_);
  }
  return heard;
}

Error FirstSeconds::nobody(std::optional<double> patience_s) const {
  std::string heard = heard_instead();
  if (!heard.empty() && !config_.model) heard += fmt::format(". {}", sensor::kWhatInstead);
  const std::string patience = patience_s ? fmt::format(" within {:g} s", *patience_s) : "";
  return {
      ErrorCode::kUnsupported,
      fmt::format("no data packets of {} came to {}{}: {}", wanted_name(), config_.place, patience,
                  heard.empty() ? "nothing came at all; `terracut doctor` and tcpdump tell "
                                  "whether anything reaches this machine"
                                : heard)};
}

Expected<calib::SensorCalibration> FirstSeconds::from_packets(sensor::SensorModel model,
                                                              std::uint32_t address) const {
  if (sensor::is_robosense(model)) {
    const auto& told = senders_.device(address).calibration(model);
    if (told) return told;
    return fail(ErrorCode::kNoCalibration,
                fmt::format("no angles of this {}: none were given, and what it says of itself to "
                            "port {} does not hold them: {}. {}",
                            to_string(model), config_.device_port, told.error().message,
                            sensor::what_to_give(model)));
  }
  if (model == sensor::SensorModel::kHdl64eS1) return sensor::fail_for_s1(config_.place);
  if (sensor::is_ouster(model)) return sensor::fail_for_ouster(config_.place);
  const hdl64e::StatusStreamReader& status = senders_.hdl64e_status(address);
  if (!status.has_table()) {
    return fail(ErrorCode::kNoCalibration,
                fmt::format("none was given, and {} bytes of the table in the packets are "
                            "missing; give the unit's db.xml or yaml with --calibration FILE",
                            status.holes()));
  }
  auto table = hdl64e::parse_stream_table(status.table());
  if (!table) return tl::unexpected(table.error());
  return *std::move(table);
}

}  // namespace terracut::streams
