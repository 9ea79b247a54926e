// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/streams/heard_senders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "firmware_io/net/ipv4_endpoint.hpp"
#include "firmware_io/packet/hdl64e_wire.hpp"
#include "firmware_io/packet/sensor_recognition.hpp"
#include "firmware_io/sensor/unknown_packets.hpp"

namespace terracut::streams {

void HeardSenders::Sender::add(const packet::Datagram& datagram,
                               std::optional<sensor::SensorModel> wanted) {
  newest_ns = datagram.stamp_ns;
  probe.add(datagram);
  const sensor::SensorModel model = sensor::recognise_sensor_as(wanted, datagram.payload);
  if (sensor::is_decoded(model)) streams.try_emplace(model, model).first->second.add(datagram);
  if (model == sensor::SensorModel::kUnknown && first_unknown.empty()) {
    const std::string guess = sensor::guess_of_unknown(datagram);
    first_unknown = fmt::format("{} bytes to port {}{}{}", datagram.payload.size(),
                                datagram.destination_port, guess.empty() ? "" : ": ", guess);
  }
  if (foreign_hints.empty() && !sensor::is_decoded(model)) {
    foreign_hints = sensor::describe_sensor_hints(datagram.payload);
  }
  (void)device.add(datagram.payload);
  const auto* packet = hdl64e::packet_in(datagram.payload);
  if (packet != nullptr && hdl64e::is_hdl64e(*packet)) {
    hdl64e_status.add(packet->status_type, packet->status_value, packet->stamp_us.value());
  }
}

std::uint64_t HeardSenders::Sender::data_packets() const {
  std::uint64_t packets = 0;
  for (const sensor::SensorModel model : sensor::kDecodedModels) packets += probe.packets_of(model);
  return packets;
}

std::vector<SensorStream> HeardSenders::Sender::sensors_of(sensor::SensorModel model) const {
  std::vector<SensorStream> all = streams.at(model).sensors();
  drop_strays(all);
  // A single sensor needs no port to identify it.
  if (all.size() == 1) all.front().source_port.reset();
  return all;
}

void HeardSenders::add(const packet::Datagram& datagram) {
  newest_ns_ = datagram.stamp_ns;
  Sender* const sender = sender_of(datagram);
  if (sender == nullptr) return void(++forgotten_datagrams_);
  sender->add(datagram, wanted_);
  if (first_known_ns_ == 0 && !rotating().empty()) first_known_ns_ = newest_ns_;
}

HeardSenders::Sender* HeardSenders::sender_of(const packet::Datagram& datagram) {
  const auto known = senders_.find(datagram.source_address);
  if (known != senders_.end()) return &known->second;
  if (senders_.size() >= kMostSenders) {
    sensor::SensorProbe newcomer(wanted_);
    newcomer.add(datagram);
    const bool is_data = std::ranges::any_of(
        sensor::kDecodedModels,
        [&](sensor::SensorModel model) { return newcomer.packets_of(model) > 0; });
    if (!is_data) return nullptr;
    const auto least = std::ranges::min_element(senders_, {}, [](const auto& entry) {
      return std::pair(entry.second.data_packets(), entry.second.newest_ns);
    });
    for (const auto& [model, datagrams] : least->second.probe.votes()) {
      forgotten_datagrams_ += datagrams;
    }
    senders_.erase(least);
  }
  return &senders_.try_emplace(datagram.source_address, wanted_).first->second;
}

std::vector<SensorStream> HeardSenders::sensors() const {
  std::vector<SensorStream> found;
  for (const auto& [address, sender] : senders_) {
    for (const auto& [model, of_model] : sender.streams) {
      if (wants(model)) std::ranges::move(of_model.sensors(), std::back_inserter(found));
    }
  }
  drop_strays(found);
  return found;
}

template <class Predicate>
std::vector<SensorStream> HeardSenders::sensors_that(const Predicate& are) const {
  std::vector<SensorStream> found;
  for (const auto& [address, sender] : senders_) {
    for (const sensor::SensorModel model : sensor::kDecodedModels) {
      if (!wants(model) || !sender.streams.contains(model)) continue;
      std::vector<SensorStream> its_own = sender.sensors_of(model);
      if (are(sender.probe, model, its_own)) {
        std::ranges::move(its_own, std::back_inserter(found));
      }
    }
  }
  return found;
}

std::vector<SensorStream> HeardSenders::rotating() const {
  return sensors_that(
      [](const sensor::SensorProbe& probe, sensor::SensorModel model, const auto& its_own) {
        // If several heads send in turn, no rotation shows, but that there are several sensors
        // does.
        return its_own.size() > 1 ? probe.packets_of(model) >= kSteady_packets : probe.knows(model);
      });
}

bool HeardSenders::is_steady_but_stands(std::uint32_t address) const {
  const auto is_at = [&](const SensorStream& sensor) { return sensor.source_address == address; };
  return std::ranges::any_of(steady(), is_at) && std::ranges::none_of(rotating(), is_at);
}

std::vector<SensorStream> HeardSenders::steady() const {
  return sensors_that(
      [](const sensor::SensorProbe& probe, sensor::SensorModel model, const auto& /*its_own*/) {
        return probe.packets_of(model) >= kSteady_packets;
      });
}

bool HeardSenders::has_told(const SensorStream& sensor) const {
  const Sender& sender = senders_.at(sensor.source_address);
  if (sensor::is_robosense(sensor.model)) return sender.device.has_calibration(sensor.model);
  // A table of this model is built in, or in a file, and its packets hold none.
  if (sensor::has_built_in_table(sensor.model) || sensor::is_ouster(sensor.model)) return true;
  return sender.hdl64e_status.has_table();
}

std::string HeardSenders::describe(const Sender& sender) const {
  for (const sensor::SensorModel model : sensor::kDecodedModels) {
    const std::uint64_t packets = sender.probe.packets_of(model);
    if (packets == 0) continue;
    if (!wants(model)) return fmt::format("{} packets of a {}", packets, to_string(model));
    if (packets < kSteady_packets)
      return fmt::format("{} data packets of {}", packets, to_string(model));
    return fmt::format("{}, whose head does not rotate,", to_string(model));
  }
  if (std::string models = sender.probe.foreign_models(); !models.empty()) {
    return sender.foreign_hints.empty() ? models
                                        : fmt::format("{} ({})", models, sender.foreign_hints);
  }
  // votes() is ordered by model, and kUnknown comes first. If there are no unknown datagrams, only
  // device packets came.
  const auto [model, datagrams] = *sender.probe.votes().begin();
  return model == sensor::SensorModel::kUnknown
             ? fmt::format("{} datagrams of no sensor known here, {},", datagrams,
                           sender.first_unknown)
             : fmt::format("{} datagrams of {}", datagrams, to_string(model));
}

std::string HeardSenders::others() const {
  std::string text;
  std::size_t named = 0;
  std::uint64_t unnamed = 0;
  // Senders of data packets are named first.
  for (const bool sends_data : {true, false}) {
    for (const auto& [address, sender] : senders_) {
      const auto is_rotating = [&, &probe = sender.probe](sensor::SensorModel model) {
        return wants(model) && probe.knows(model);
      };
      if ((sender.data_packets() > 0) != sends_data) continue;
      if (std::ranges::any_of(sensor::kDecodedModels, is_rotating)) continue;
      if (++named > kMostNamed) {
        ++unnamed;
        continue;
      }
      text += fmt::format("{}{} from {}", text.empty() ? "" : "; ", describe(sender),
                          net::ipv4_text(address));
    }
  }
  if (unnamed > 0) text += fmt::format("; {} others", unnamed);
  if (forgotten_datagrams_ > 0) {
    text +=
        fmt::format("; {} datagrams of more addresses than are remembered", forgotten_datagrams_);
  }
  return text;
}

HeardCapture hear_beginning(capture::CaptureSource& source,
                            std::optional<sensor::SensorModel> wanted) {
  // About a second of datagrams: enough to measure the spin rate, and for a stream that begins with
  // other packets.
  constexpr int kMostDatagrams = 6'000;
  HeardCapture heard{.senders = HeardSenders(wanted), .broke_off = {}};
  for (int i = 0; i < kMostDatagrams; ++i) {
    const auto next = source.next();
    if (!next) heard.broke_off = next.error();
    if (!next || !*next) break;
    heard.senders.add(**next);
  }
  return heard;
}

}  // namespace terracut::streams
