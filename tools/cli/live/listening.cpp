// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "listening.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/streams/hear_sensor.hpp"
#include "known_sensor.hpp"
#include "tools/cli/console.hpp"
#include "tools/cli/settings/sensor_choice.hpp"
#include "tools/cli/stop_signal.hpp"

namespace terracut::cli {
namespace {

/// Opens the device port so that other programs that share it keep receiving.
std::optional<net::LiveSource> open_device_port(const Options& options,
                                                memory::FixedMemory& memory) {
  net::ListenConfig listen = listen_config_of(options);
  listen.at.port = options.listen.device_port;
  listen.share_port = true;
  listen.sender.reset();
  auto opened = net::LiveSource::open(listen, memory);
  if (opened) return *std::move(opened);
  if (options.capture.sensor && sensor::is_robosense(*options.capture.sensor)) {
    warn("the sensor's device information is not heard: " + opened.error().message);
  }
  return std::nullopt;
}

/// Returns the longest payload that the sensor may send: more than one Ethernet frame only of an
/// Ouster, which must be named, or its metadata given.
std::size_t longest_payload_of(const CaptureOptions& capture) {
  const sensor::SensorModel model = named_model(capture).value_or(sensor::SensorModel::kUnknown);
  constexpr std::size_t kEthernetFrame = 1536;
  return std::max(kEthernetFrame, sensor::row_of(model).longest_packet_bytes);
}

}  // namespace

net::ListenConfig listen_config_of(const Options& options) {
  const ListenOptions& listen = options.listen;
  net::ListenConfig config{.at = net::parse_ipv4_endpoint(listen.address).value(),
                           .by_libpcap = listen.via == ListenVia::kLibpcap,
                           .interface = listen.interface,
                           .multicast_group = {},
                           .share_port = listen.share_port,
                           .sender = {},
                           .slot_bytes = longest_payload_of(options.capture)};
  if (!listen.multicast.empty()) {
    config.multicast_group = net::parse_ipv4_address(listen.multicast).value();
  }
  if (!options.capture.from.empty()) {
    config.sender = net::parse_ipv4_sender(options.capture.from).value();
  }
  return config;
}

Expected<streams::SensorOnAir> listen_for_sensor(net::LiveSource& source, const Options& options,
                                                 const OnWaiting& on_waiting) {
  const KnownSensor known(options.watch.name);
  streams::FirstSeconds first(
      {.model = named_model(options.capture),
       .columns = options.capture.columns,
       .calibration = {{}, options.capture.calibration, options.capture.nominal_calibration},
       .place = source.name(),
       .device_port = options.listen.device_port,
       .known = known.sender()});
  memory::FixedMemory device_memory;
  std::optional<net::LiveSource> device;
  if (first.wants_device_port()) device = open_device_port(options, device_memory);
  auto sensor = streams::hear_sensor(first, source, device ? &*device : nullptr,
                                     {options.patience_s, stop_wanted, on_waiting});
  if (!sensor || stop_wanted()) return sensor;
  if (const std::string others = first.other_sensors(); !others.empty()) {
    warn(
        fmt::format("several sensors send here; {}, which was in use before, is heard and not {}. "
                    "--from chooses one for good",
                    to_string(sensor->sender), others));
  }
  known.remember(sensor->sender);
  return sensor;
}

}  // namespace terracut::cli
