// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sender_streams.hpp"

#include <algorithm>
#include <functional>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include "firmware_io/packet/hdl64e_wire.hpp"

namespace terracut::streams {
namespace {

/// More contradictions than this are not caused by reordered packets.
constexpr std::uint64_t kNoChance = 5;
constexpr std::size_t kMostSources = 16;
constexpr std::int64_t kLongestStep_us = 10'000'000;

/// A sort key that puts larger numbers first.
constexpr std::uint64_t most_first(std::uint64_t packets) noexcept {
  return ~packets;
}

std::uint64_t hash_of(std::span<const std::uint8_t> payload) {
  return std::hash<std::string_view>{}(
      {reinterpret_cast<const char*>(payload.data()), payload.size()});
}

/// True if one head cannot send a packet `step_us` after another one, because that is too soon or
/// too late.
bool is_contradiction(std::int64_t step_us, const packet::PacketAzimuths& azimuths) {
  const std::int64_t least_ns = std::int64_t{azimuths.nominal_period_ns} * 3 / 4;
  return step_us * 1000 < least_ns || step_us > kLongestStep_us;
}

}  // namespace

void SenderStreams::Turns::add(bool contradicts) {
  ++all;
  contradicting += contradicts ? 1 : 0;
}

bool SenderStreams::Turns::are_of_several() const {
  return contradicting >= kNoChance && !are_of_one_head();
}

void SenderStreams::Sources::add(std::uint64_t mark, std::optional<bool> contradicts) {
  if (contradicts && mark != newest) turns.add(*contradicts);
  newest = mark;
  if (packets.size() < kMostSources || packets.contains(mark)) ++packets[mark];
}

bool SenderStreams::Sources::tell_apart() const {
  // If each packet comes from another port, ports cannot identify sensors.
  return packets.size() < kMostSources && turns.are_of_several();
}

void SenderStreams::add(const packet::Datagram& datagram) {
  source_address_ = datagram.source_address;
  const Destination destination = destination_of(datagram);
  if (places_.size() >= kMostDestinations && !places_.contains(destination)) return;
  Place& place = places_[destination];
  ++place.packets;
  if (is_copy(datagram)) return;

  packet::PacketAzimuths azimuths;
  const bool is_read = !reader_.read(model_, datagram, azimuths);
  ++packets_;
  std::optional<bool> elsewhere, here;
  if (is_read && model_ != sensor::SensorModel::kHdl64eS1) {
    const auto contradicts = [&](std::optional<std::int64_t>& before_us) -> std::optional<bool> {
      const std::int64_t now_us = azimuths.device_stamp_us;
      const auto before = std::exchange(before_us, now_us);
      if (!before) return std::nullopt;
      has_clock_ = has_clock_ || now_us != *before;
      if (!has_clock_) return std::nullopt;
      return is_contradiction(packet::clock_step_us(*before, now_us, hdl64e::kDeviceHour_us),
                              azimuths);
    };
    elsewhere = contradicts(newest_us_);
    here = contradicts(place.newest_us);
  }
  if (elsewhere && destination != newest_) turns_.add(*elsewhere);
  if (here) place.steps.add(*here);
  newest_ = destination;
  place.ports.add(datagram.source_port, here);
  place.macs.add(datagram.source_mac, here);
}

bool SenderStreams::is_copy(const packet::Datagram& datagram) {
  const std::uint64_t hash = hash_of(datagram.payload);
  const Destination destination = destination_of(datagram);
  const auto [first, is_new] = first_at_.try_emplace(hash, destination);
  if (is_new) {
    payloads_.push_back(hash);
    if (payloads_.size() > kMostPayloads) {
      first_at_.erase(payloads_.front());
      payloads_.pop_front();
    }
    return false;
  }
  if (first->second != destination) ++copies_[std::minmax(first->second, destination)];
  return true;
}

bool SenderStreams::are_copies(const Destination& a, const Destination& b) const {
  const auto found = copies_.find(std::minmax(a, b));
  const std::uint64_t fewer = std::min(places_.at(a).packets, places_.at(b).packets);
  return found != copies_.end() && found->second * 2 >= fewer;
}

bool SenderStreams::is_one_stream_spread() const {
  constexpr std::uint64_t kOften = 8;
  return turns_.all >= kOften && turns_.all * kOften >= packets_ && turns_.are_of_one_head();
}

std::vector<SenderStreams::Group> SenderStreams::groups() const {
  Group all;
  for (const auto& [destination, place] : places_) all.push_back(destination);
  std::ranges::sort(all, {}, [&](const Destination& destination) {
    return std::pair(most_first(places_.at(destination).packets), destination);
  });
  if (all.empty()) return {};
  if (is_one_stream_spread()) return {all};
  std::vector<Group> groups;
  for (const Destination& destination : all) {
    const auto its_own = std::ranges::find_if(groups, [&](const Group& group) {
      return std::ranges::any_of(
          group, [&](const Destination& other) { return are_copies(destination, other); });
    });
    if (its_own == groups.end()) {
      groups.push_back({destination});
    } else {
      its_own->push_back(destination);
    }
  }
  return groups;
}

void SenderStreams::add_sensors_of(const Group& group, std::vector<SensorStream>& sensors) const {
  SensorStream whole{
      .source_address = source_address_, .model = model_, .destinations = group, .packets = 0};
  std::map<std::uint64_t, std::uint64_t> by_port, by_mac;
  bool have_ports = false, have_macs = false;
  for (const Destination& destination : group) {
    const Place& place = places_.at(destination);
    whole.packets += place.packets;
    have_ports |= place.ports.tell_apart();
    have_macs |= place.macs.tell_apart();
    whole.contradicts_itself |= place.steps.are_of_several();
    for (const auto& [port, packets] : place.ports.packets) by_port[port] += packets;
    for (const auto& [mac, packets] : place.macs.packets) by_mac[mac] += packets;
  }
  if (!have_ports && !have_macs) return sensors.push_back(std::move(whole));
  whole.contradicts_itself = false;
  for (const auto& [mark, packets] : have_ports ? by_port : by_mac) {
    SensorStream& one = sensors.emplace_back(whole);
    one.packets = packets;
    if (have_ports) {
      one.source_port = static_cast<std::uint16_t>(mark);
    } else {
      one.source_mac = mark;
    }
  }
}

std::vector<SensorStream> SenderStreams::sensors() const {
  std::vector<SensorStream> sensors;
  for (const Group& group : groups()) add_sensors_of(group, sensors);
  std::ranges::sort(sensors, {}, [](const SensorStream& sensor) {
    return std::tuple(most_first(sensor.packets), sensor.destinations, sensor.source_port,
                      sensor.source_mac);
  });
  return sensors;
}

}  // namespace terracut::streams
