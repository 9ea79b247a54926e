// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tests/simulation/network.hpp"

#include <algorithm>
#include <utility>

namespace terracut::simulation {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kLeastWay_ns = 30'000, kMostWay_ns = 60'000;  ///< From sensor to kernel.
constexpr std::int64_t kLeastWakeUp_ns = 5'000, kMostWakeUp_ns = 60'000;
constexpr std::int64_t kLookEvery_ns = 500 * kMs;  ///< As UdpSource looks after its interface.
constexpr std::size_t kGarbageBytes = 100;
/// A sensor's clock shows up to so much with its first packet: no two starts are alike.
constexpr std::int64_t kMostBoot_us = 100'000;
/// The twin's head and clock are elsewhere.
constexpr std::size_t kTwinAhead = 31;
constexpr std::int64_t kTwinClock_us = 1'234'567'891;

}  // namespace

Network::Network(const SensorLoop& loop, const BlindPlaces& blind, const Faults& faults,
                 Machine& machine, std::size_t room_packets, std::uint64_t seed)
    : loop_(loop),
      blind_(blind),
      faults_(faults),
      machine_(machine),
      room_packets_(room_packets),
      dice_(seed),
      done_(faults.size()),
      sensor_place_(static_cast<std::size_t>(
          dice_.between(0, static_cast<std::int64_t>(loop.packets.size()) - 1))),
      booted_ns_(0),
      boot_us_(dice_.between(0, 3'599'999'999)) {}

std::span<const packet::Datagram> Network::receive(std::int64_t timeout_ns) noexcept {
  const OffTheRecord own_memory;
  const std::int64_t until_ns = machine_.now_ns() + timeout_ns;
  for (;;) {
    deliver_to(machine_.now_ns());
    const std::size_t count = std::min(buffer_.size(), net::kBatchDatagrams);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Sent sent = buffer_.front();
      buffer_.pop_front();
      if (sent.kind == Kind::kForeign) {
        ++counters_.foreign;
        continue;
      }
      datagrams_[kept] = {.payload = write(sent, kept), .stamp_ns = sent.stamp_ns};
      ++kept;
    }
    counters_.received += count;
    counters_.delivered += kept;
    if (count == net::kBatchDatagrams) refresh_drops();
    if (kept > 0) {
      quiet_since_ns_ = machine_.now_ns();
      link_ = net::LinkState::kUp;
      return std::span(datagrams_).first(kept);
    }
    if (machine_.now_ns() - quiet_since_ns_ >= kLookEvery_ns) {
      quiet_since_ns_ = machine_.now_ns();
      refresh_drops();
      const bool is_down = is_on(FaultKind::kCablePulled, machine_.now_ns());
      if (is_down && link_ == net::LinkState::kUp) ++counters_.link_losses;
      link_ = is_down ? net::LinkState::kDown : net::LinkState::kUp;
    }
    if (machine_.now_ns() >= until_ns) return {};
    const std::int64_t wanted_ns =
        std::min(until_ns, std::max(machine_.now_ns(), quiet_since_ns_ + kLookEvery_ns));
    const std::int64_t next_ns = next_arrival_ns(wanted_ns);
    machine_.wait_until(next_ns + dice_.between(kLeastWakeUp_ns, kMostWakeUp_ns));
  }
}

std::span<const std::uint8_t> Network::write(const Sent& sent, std::size_t slot) noexcept {
  SensorLoop::Packet& bytes = bytes_[slot];
  if (sent.kind == Kind::kGarbage) return std::span(bytes).first(kGarbageBytes);
  bytes = loop_.packets[sent.place];
  set_device_stamp(bytes, sent.device_us);
  if (sent.kind == Kind::kStanding) stop_head(bytes);
  if (sent.kind == Kind::kTruncated) return std::span(bytes).first(bytes.size() / 2);
  return bytes;
}

std::optional<Network::Came> Network::packet_of(std::int64_t stamp_ns) const noexcept {
  const auto found = std::ranges::find(came_, stamp_ns, &Came::stamp_ns);
  if (found == came_.end()) return std::nullopt;
  return *found;
}

// --- The kernel's buffer ---

void Network::deliver_to(std::int64_t at_ns) {
  while (next_arrival_ns(at_ns + 1) <= at_ns) {
    Sent sent = under_way_.top();
    under_way_.pop();
    const bool is_of_sensor = sent.kind == Kind::kData || sent.kind == Kind::kTruncated;
    if (buffer_.size() >= room_packets_) {
      ++truth_.dropped;
      if (is_of_sensor && !sent.is_again) ++truth_.packets_lost;
      continue;
    }
    ++truth_.taken;
    if (sent.kind == Kind::kForeign) ++truth_.foreign;
    if (sent.kind == Kind::kGarbage || sent.kind == Kind::kTruncated) ++truth_.of_wrong_size;
    if (sent.kind == Kind::kTruncated && !sent.is_again) ++truth_.packets_lost;
    if (sent.kind == Kind::kData && sent.is_again) ++truth_.repeated;
    sent.stamp_ns = machine_.time_of_day_ns(sent.arrival_ns);
    if (sent.kind == Kind::kData) {
      came_[next_came_++ % came_.size()] = {sent.stamp_ns, sent.arrival_ns, sent.place};
    }
    buffer_.push_back(sent);
  }
}

std::int64_t Network::next_arrival_ns(std::int64_t limit_ns) {
  const auto first_ns = [&] {
    return under_way_.empty() ? limit_ns : std::min(limit_ns, under_way_.top().arrival_ns);
  };
  while (next_sent_ns() < first_ns()) send_next();
  return first_ns();
}

// --- Who sends ---

bool Network::is_on(FaultKind kind, std::int64_t at_ns) const noexcept {
  return std::ranges::any_of(faults_, [&](const Fault& fault) { return fault.is_on(kind, at_ns); });
}

std::int64_t Network::device_us(std::int64_t at_ns) const noexcept {
  std::int64_t time_us = boot_us_ + (at_ns - booted_ns_) / 1000;
  for (const Fault& fault : faults_) {
    const bool is_set = fault.kind == FaultKind::kDeviceClock && fault.at_ns() >= booted_ns_ &&
                        fault.at_ns() <= at_ns;
    if (is_set) time_us += fault.amount * 1000;
    if (fault.kind == FaultKind::kDeviceClockSlow && fault.at_ns() >= booted_ns_) {
      const std::int64_t slow_us =
          std::clamp<std::int64_t>(at_ns - fault.at_ns(), 0, fault.span_ms * kMs) / 1000;
      time_us -= slow_us - slow_us / std::max<std::int64_t>(1, fault.amount);
    }
  }
  return time_us;
}

/// One of the `amount` packets that a fault befalls from its time on.
bool Network::take_one(std::size_t fault, std::int64_t at_ns) noexcept {
  const bool is_befallen =
      at_ns >= faults_[fault].at_ns() && done_[fault].count < faults_[fault].amount;
  if (is_befallen) ++done_[fault].count;
  return is_befallen;
}

std::int64_t Network::next_sent_ns() const noexcept {
  std::int64_t next_ns = sensor_next_ns_;
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const Fault& fault = faults_[i];
    const std::int64_t due_ns = std::max(fault.at_ns(), done_[i].next_ns);
    const bool sends = ((fault.kind == FaultKind::kOtherSender || fault.kind == FaultKind::kTwin) &&
                        due_ns < fault.end_ns()) ||
                       (fault.kind == FaultKind::kGarbage && !done_[i].begun);
    if (sends) next_ns = std::min(next_ns, due_ns);
  }
  return next_ns;
}

void Network::send_next() {
  const std::int64_t at_ns = next_sent_ns();
  send_of_others(at_ns);
  if (at_ns < sensor_next_ns_) return;
  sensor_next_ns_ += loop_.period_ns;
  send_packet(at_ns);
}

void Network::send_of_others(std::int64_t at_ns) {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const Fault& fault = faults_[i];
    Done& done = done_[i];
    if (fault.kind == FaultKind::kGarbage) {
      if (at_ns < fault.at_ns() || done.begun) continue;
      done.begun = true;
      for (std::int64_t n = 0; n < fault.amount; ++n) {
        put({.arrival_ns = at_ns, .kind = Kind::kGarbage});
      }
      continue;
    }
    if (at_ns < std::max(fault.at_ns(), done.next_ns) || at_ns >= fault.end_ns()) continue;
    if (fault.kind == FaultKind::kOtherSender) {
      put({.arrival_ns = at_ns, .kind = Kind::kForeign});
      done.next_ns = at_ns + 1'000 * kMs / std::max<std::int64_t>(1, fault.amount);
    } else if (fault.kind == FaultKind::kTwin) {
      const std::size_t place =
          (kTwinAhead + static_cast<std::size_t>(done.count++)) % loop_.packets.size();
      put({.arrival_ns = at_ns,
           .kind = Kind::kTwin,
           .place = place,
           .device_us = kTwinClock_us + at_ns / 1000});
      done.next_ns = at_ns + loop_.period_ns;
    }
  }
}

bool Network::restarts(std::int64_t at_ns) noexcept {
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const Fault& fault = faults_[i];
    const bool begins = fault.kind == FaultKind::kSensorRestart && at_ns >= fault.at_ns();
    if (!begins || std::exchange(done_[i].begun, true)) continue;
    sensor_next_ns_ = booted_ns_ = std::max(at_ns, fault.end_ns());
    boot_us_ = dice_.between(0, kMostBoot_us);
    sensor_place_ = loop_.packets.size() * static_cast<std::size_t>(fault.amount) / 1000;
    return true;
  }
  return false;
}

void Network::send_packet(std::int64_t at_ns) {
  if (restarts(at_ns)) return;
  const std::size_t place = sensor_place_;
  const bool head_stands = is_on(FaultKind::kHeadStands, at_ns);
  if (!head_stands) sensor_place_ = (place + 1) % loop_.packets.size();
  if (blind_.holds(place, loop_)) return;
  Sent sent{.arrival_ns = at_ns + dice_.between(kLeastWay_ns, kMostWay_ns),
            .kind = head_stands ? Kind::kStanding : Kind::kData,
            .place = place,
            .device_us = device_us(at_ns)};
  bool is_lost = is_on(FaultKind::kCablePulled, at_ns), comes_twice = false;
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const Fault& fault = faults_[i];
    if (at_ns < fault.at_ns()) continue;
    switch (fault.kind) {
      case FaultKind::kLoss:
        is_lost = take_one(i, at_ns) || is_lost;
        break;
      case FaultKind::kTruncated:
        if (take_one(i, at_ns)) sent.kind = Kind::kTruncated;
        break;
      case FaultKind::kDuplicate:
        comes_twice = take_one(i, at_ns) || comes_twice;
        break;
      case FaultKind::kReorder:
        if (done_[i].begun) break;
        done_[i].begun = true;
        sent.arrival_ns += fault.amount * loop_.period_ns;
        break;
      case FaultKind::kBurst:
        if (at_ns < fault.end_ns()) sent.arrival_ns = std::max(sent.arrival_ns, fault.end_ns());
        break;
      default:
        break;
    }
  }
  if (is_lost) {
    ++truth_.packets_lost;
    return;
  }
  put(sent);
  sent.is_again = true;
  if (comes_twice) put(sent);
}

void Network::put(Sent sent) {
  sent.number = numbers_++;
  under_way_.push(sent);
}

}  // namespace terracut::simulation
