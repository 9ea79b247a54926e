// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "heard_senders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "firmware_io/hdl64e/wire.hpp"
#include "firmware_io/net/ipv4_endpoint.hpp"

namespace terracut::sensor {

void HeardSenders::add(const decode::Datagram& datagram) {
  const auto known = senders_.find(datagram.source_address);
  if (known == senders_.end() && senders_.size() >= kMostSenders) return;
  Sender& sender = senders_[datagram.source_address];
  sender.probe.add(datagram);
  (void)sender.ruby128_device.add(datagram.payload);
  const auto* packet = hdl64e::packet_in(datagram.payload);
  if (packet != nullptr && hdl64e::is_hdl64e(*packet)) {
    sender.hdl64e_status.add(packet->status_type, packet->status_value, packet->stamp_us.value());
  }
  newest_ns_ = datagram.stamp_ns;
  if (first_known_ns_ == 0 && !rotating().empty()) first_known_ns_ = newest_ns_;
}

template <class Predicate>
std::vector<HeardSenders::Sensor> HeardSenders::sensors_that(const Predicate& are) const {
  std::vector<Sensor> found;
  for (const auto& [address, sender] : senders_) {
    for (const SensorModel model : kDecodedModels) {
      if (wants(model) && std::invoke(are, sender.probe, model)) found.push_back({address, model});
    }
  }
  return found;
}

std::vector<HeardSenders::Sensor> HeardSenders::rotating() const {
  return sensors_that(&SensorProbe::knows);
}

std::vector<HeardSenders::Sensor> HeardSenders::steady() const {
  return sensors_that([](const SensorProbe& probe, SensorModel model) {
    return probe.packets_of(model) >= kSteady_packets;
  });
}

bool HeardSenders::has_told(const Sensor& sensor) const {
  if (velodyne_model_of(sensor.model)) return true;  // it is known without
  const Sender& sender = senders_.at(sensor.address);
  return sensor.model == SensorModel::kRuby128 ? sender.ruby128_device.has_calibration()
                                               : sender.hdl64e_status.has_table();
}

std::string HeardSenders::describe(const Sender& sender) const {
  for (const SensorModel model : kDecodedModels) {
    const std::uint64_t packets = sender.probe.packets_of(model);
    if (packets == 0) continue;
    if (!wants(model))
      return fmt::format("{} packets of another sensor, {}", packets, to_string(model));
    if (packets < kSteady_packets)
      return fmt::format("{} data packets of {}", packets, to_string(model));
    return fmt::format("{}, whose head does not rotate,", to_string(model));
  }
  if (std::string models = sender.probe.foreign_models(); !models.empty()) return models;
  return fmt::format("{} datagrams of no sensor known here",
                     sender.probe.packets_of(SensorModel::kUnknown));
}

std::string HeardSenders::others() const {
  std::string text;
  for (const auto& [address, sender] : senders_) {
    const auto is_rotating = [&](SensorModel model) {
      return wants(model) && sender.probe.knows(model);
    };
    if (std::ranges::any_of(kDecodedModels, is_rotating)) continue;
    text += fmt::format("{}{} from {}", text.empty() ? "" : "; ", describe(sender),
                        net::ipv4_text(address));
  }
  return text;
}

}  // namespace terracut::sensor
