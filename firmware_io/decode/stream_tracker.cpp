// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/decode/stream_tracker.hpp"

#include <algorithm>
#include <cstdlib>

namespace terracut::decode {
namespace {

/// A packet older than the newest by up to this is out of order; if it is older still, the clock
/// has jumped.
constexpr std::int64_t kReorder_us = 20'000;
/// A longer step of the device clock is a gap only if the host's clock agrees.
constexpr std::int64_t kOutage_us = 1'000'000;
/// Longer outages (more than a day) are not counted as lost packets.
constexpr std::int64_t kLongestOutage_us = 86'400'000'000;
/// In a gap wider than this, missing packets are reported even if the period is not known.
constexpr std::int64_t kWide_ticks = packet::kRevolution_ticks / 90;
/// The azimuth is counted on from revolution to revolution up to this limit, which a head reaches
/// after years; then the count begins again.
constexpr std::int64_t kFarthest_cdeg = 100'000'000'000'000;
/// The head may be this far from the azimuth predicted from time and speed, plus an eighth of its
/// rotation since.
constexpr std::int64_t kRotorSlack_cdeg = 2'000;
/// A missing packet may still arrive out of order during this many packets.
constexpr int kMissingGrace_packets = 16;
/// If this many successive steps do not fit the period (after a change of return mode), it is
/// measured again.
constexpr int kOffPeriodBeforeRemeasure = 64;
/// The period is the mean over some thousand packets.
constexpr std::int64_t kPeriodMean_packets = 8'192;
/// A repeat is recognised within this many packets. Slots are direct-mapped by time; a slot is
/// shorter than the shortest packet period, so neighbours never share one.
constexpr std::uint32_t kRepeatWindow_packets = 1'024;
constexpr std::size_t kSeenSlots = 8'192;
constexpr std::int64_t kSeenSlot_us = 64;

/// Returns the host's time step; wraps, because the stamps of a capture may be anything.
std::int64_t host_step_us(std::int64_t from_ns, std::int64_t to_ns) noexcept {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(to_ns) -
                                   static_cast<std::uint64_t>(from_ns)) /
         1000;
}

/// True if the gap was as long by the host's clock as by the device's, or if the host's clock
/// cannot tell.
bool takes_its_time(std::int64_t step_us, std::int64_t host_us) noexcept {
  return step_us <= kReorder_us || host_us <= 0 || 4 * host_us >= step_us;
}

}  // namespace

StreamTracker::StreamTracker(std::int64_t clock_wrap_us, memory::FixedMemory& memory)
    : clock_wrap_us_(clock_wrap_us), seen_(memory.take<Seen>("stream tracker", kSeenSlots)) {}

StreamTracker::Seen StreamTracker::seen(const packet::PacketAzimuths& azimuths) noexcept {
  return {static_cast<std::uint32_t>(azimuths.device_stamp_us),
          static_cast<std::uint16_t>(azimuths.first_cdeg()),
          static_cast<std::uint16_t>(azimuths.last_cdeg()), 0};
}

std::size_t StreamTracker::slot_of(const packet::PacketAzimuths& azimuths) noexcept {
  return static_cast<std::size_t>(azimuths.device_stamp_us / kSeenSlot_us) % kSeenSlots;
}

bool StreamTracker::is_repeat(const packet::PacketAzimuths& azimuths) const noexcept {
  const Seen& before = seen_[slot_of(azimuths)];
  const Seen now = seen(azimuths);
  return before.packet != 0 && before.stamp_us == now.stamp_us &&
         before.first_cdeg == now.first_cdeg && before.last_cdeg == now.last_cdeg &&
         packets_ - before.packet <= kRepeatWindow_packets;
}

void StreamTracker::remember(const packet::PacketAzimuths& azimuths) noexcept {
  Seen& slot = seen_[slot_of(azimuths)];
  slot = seen(azimuths);
  slot.packet = packets_;
}

Placement StreamTracker::place(const packet::PacketAzimuths& azimuths, std::int64_t host_stamp_ns,
                               std::int64_t next_cdeg, frame::LossCounters& losses) noexcept {
  ++packets_;
  if (is_repeat(azimuths)) return {Arrival::kRejected, frame::Reject::kRepeated, 0, 0, 0, false};
  if (!started_) return restart(azimuths, host_stamp_ns, losses);
  const Placement placed = follow(azimuths, host_stamp_ns, next_cdeg, losses);
  if (placed.arrival == Arrival::kRejected) return doubt(azimuths, host_stamp_ns, placed.reject);
  doubtful_packets_ = 0;
  return placed;
}

Placement StreamTracker::begin(const packet::PacketAzimuths& azimuths, std::int64_t host_stamp_ns,
                               frame::LossCounters& losses) noexcept {
  const std::int64_t step_us = device_step_us(newest_.stamp_us, azimuths.device_stamp_us);
  if (step_us < -kReorder_us || step_us > kReorder_us) ++losses.clock_jumps;
  return restart(azimuths, host_stamp_ns, losses);
}

Placement StreamTracker::go_on(const packet::PacketAzimuths& azimuths, std::int64_t host_stamp_ns,
                               std::int64_t next_cdeg, frame::LossCounters& losses) noexcept {
  if (is_repeat(azimuths)) return {Arrival::kRejected, frame::Reject::kRepeated, 0, 0, 0, false};
  return follow(azimuths, host_stamp_ns, next_cdeg, losses);
}

Placement StreamTracker::doubt(const packet::PacketAzimuths& azimuths, std::int64_t host_stamp_ns,
                               frame::Reject reason) noexcept {
  const std::int64_t step_us = device_step_us(doubtful_.stamp_us, azimuths.device_stamp_us);
  if (doubtful_packets_ > 0 && step_us == 0 &&
      beams::wrap_cdeg(doubtful_.rotor_cdeg) == azimuths.first_cdeg()) {
    return {Arrival::kRejected, frame::Reject::kRepeated, 0, 0, 0, false};
  }
  const bool may_follow = doubtful_packets_ > 0 && step_us >= -kReorder_us &&
                          step_us <= kOutage_us &&
                          takes_its_time(step_us, host_step_us(doubtful_.host_ns, host_stamp_ns));
  const auto rotor_cdeg = may_follow ? head_after(doubtful_, azimuths) : std::nullopt;
  // A blind sector may lie between the doubtful packet and this one; but after more than a
  // revolution any angle would fit.
  const bool agrees = rotor_cdeg && *rotor_cdeg - doubtful_.rotor_cdeg <= beams::kRevolution_cdeg;
  const std::int64_t in_doubt_cdeg = agrees ? *rotor_cdeg : azimuths.first_cdeg();
  if (!agrees || step_us >= 0) {
    doubtful_ = {azimuths.device_stamp_us, host_stamp_ns, in_doubt_cdeg, azimuths.pace_ticks};
  }
  doubtful_packets_ = agrees ? doubtful_packets_ + 1 : 1;
  note_rejected(azimuths.device_stamp_us);
  if (doubtful_packets_ < kNewStream_packets) {
    return {Arrival::kDoubtful, reason, in_doubt_cdeg, 0, 0, !agrees};
  }
  doubtful_packets_ = 0;
  return {Arrival::kNewStream, reason, in_doubt_cdeg, 0, 0, false};
}

/// Returns the unwrapped azimuth at which the packet fits by time and speed; nothing if it does not
/// fit.
std::optional<std::int64_t> StreamTracker::head_after(
    const Newest& newest, const packet::PacketAzimuths& azimuths) const noexcept {
  const std::int64_t step_us = device_step_us(newest.stamp_us, azimuths.device_stamp_us);
  const std::int64_t rotated_cdeg =
      newest.pace_ticks * (step_us * 1000) / period_in_use_ns() / packet::kTicksPerCdeg;
  const std::int64_t expected_cdeg = newest.rotor_cdeg + rotated_cdeg;
  const std::int64_t off_cdeg =
      beams::step_cdeg(beams::wrap_cdeg(expected_cdeg), azimuths.first_cdeg());
  if (std::abs(off_cdeg) > kRotorSlack_cdeg + std::abs(rotated_cdeg) / 8) return std::nullopt;
  return expected_cdeg + off_cdeg;
}

/// Places a packet that continues from the newest one, and rejects one that does not.
Placement StreamTracker::follow(const packet::PacketAzimuths& azimuths, std::int64_t host_stamp_ns,
                                std::int64_t next_cdeg, frame::LossCounters& losses) noexcept {
  const std::int64_t step_us = device_step_us(newest_.stamp_us, azimuths.device_stamp_us);
  const std::int64_t step_cdeg =
      beams::step_cdeg(beams::wrap_cdeg(newest_.rotor_cdeg), azimuths.first_cdeg());

  const bool keeps_rotating =
      step_cdeg >= 0 && step_cdeg * packet::kTicksPerCdeg <= 3 * newest_.pace_ticks;
  if (azimuths.clock_restarts) {
    steps_ = 0;  // the earlier steps were measured at a wrong period
    missing_ = 0;
    if (!keeps_rotating) return restart(azimuths, host_stamp_ns, losses);
    take_as_newest(azimuths, host_stamp_ns, newest_.rotor_cdeg + step_cdeg, losses);
    return {Arrival::kNext, frame::Reject::kCount, newest_.rotor_cdeg, 0, 0, false};
  }

  const std::int64_t host_us = host_step_us(newest_.host_ns, host_stamp_ns);
  if (step_us < -kReorder_us || step_us > kOutage_us) {
    const bool is_outage = step_us > 0 && step_us < kLongestOutage_us &&
                           std::abs(host_us - step_us) < std::max(step_us / 16, kReorder_us);
    if (is_outage) {
      const std::int64_t missing = missing_in({step_us, explained_});
      Placement placed = restart(azimuths, host_stamp_ns, losses);
      placed.missing = missing;
      return placed;
    }
    // While packets are in doubt, this packet may come from another stream whose head happens to
    // pass where the first one stood.
    const bool only_the_clock_was_set = keeps_rotating && doubtful_packets_ == 0;
    if (!only_the_clock_was_set)
      return {Arrival::kRejected, frame::Reject::kClockJump, 0, 0, 0, false};
    ++losses.clock_jumps;
    take_as_newest(azimuths, host_stamp_ns, newest_.rotor_cdeg + step_cdeg, losses);
    return {Arrival::kNext, frame::Reject::kCount, newest_.rotor_cdeg, 0, 0, false};
  }
  const auto rotor_cdeg = head_after(newest_, azimuths);
  // Packets from both sides of a blind sector may have been held up, and arrive at once.
  const bool is_next =
      rotor_cdeg && std::abs(*rotor_cdeg - next_cdeg) * packet::kTicksPerCdeg <= newest_.pace_ticks;
  if (!is_next && !takes_its_time(step_us, host_us))
    return {Arrival::kRejected, frame::Reject::kClockJump, 0, 0, 0, false};
  if (!rotor_cdeg) return {Arrival::kRejected, frame::Reject::kAzimuthJump, 0, 0, 0, false};
  if (std::abs(*rotor_cdeg) > kFarthest_cdeg) return restart(azimuths, host_stamp_ns, losses);
  if (step_us < 0) {
    if (missing_ > 0 || period_ns_ == 0) --missing_;
    remember(azimuths);
    return {Arrival::kReordered, frame::Reject::kCount, *rotor_cdeg, 0, 0, false};
  }
  adopt_range(azimuths, losses);
  Placement placed{Arrival::kNext, frame::Reject::kCount, *rotor_cdeg, 0, explained_, false};
  if (step_us == 0) {
    ++losses.clock_jumps;  // the clock stands still while the head rotates
  } else {
    // A wide gap may be the sensor's blind sector: the caller decides.
    const bool is_wide = (*rotor_cdeg - newest_.rotor_cdeg) * packet::kTicksPerCdeg > kWide_ticks;
    const bool is_measured = period_ns_ != 0;
    if (is_measured || is_wide) placed.missing = missing_in({step_us, explained_});
    if (is_measured || !is_wide) measure_period(step_us, losses);
  }
  take_as_newest(azimuths, host_stamp_ns, *rotor_cdeg, losses);
  return placed;
}

void StreamTracker::take_as_newest(const packet::PacketAzimuths& azimuths,
                                   std::int64_t host_stamp_ns, std::int64_t rotor_cdeg,
                                   frame::LossCounters& losses) noexcept {
  adopt_range(azimuths, losses);
  remember(azimuths);
  newest_ = {azimuths.device_stamp_us, host_stamp_ns, rotor_cdeg, azimuths.pace_ticks};
  explained_ = 0;
}

Placement StreamTracker::restart(const packet::PacketAzimuths& azimuths, std::int64_t host_stamp_ns,
                                 frame::LossCounters& losses) noexcept {
  fix_period(losses);
  commit_missing(losses);
  started_ = true;
  doubtful_packets_ = 0;
  take_as_newest(azimuths, host_stamp_ns, azimuths.first_cdeg(), losses);
  return {Arrival::kRestart, frame::Reject::kCount, newest_.rotor_cdeg, 0, 0, false};
}

// --- Missing packets, by the device's own stamps ---

std::int64_t StreamTracker::missing_in(const Step& step) const noexcept {
  const std::int64_t period_ns = period_in_use_ns();
  const std::int64_t periods = (step.us * 1000 + period_ns / 2) / period_ns;
  return std::max<std::int64_t>(0, periods - 1 - step.explained);
}

void StreamTracker::miss(std::int64_t packets, frame::LossCounters& losses) noexcept {
  if (packets > 0) {
    missing_ += packets;
    packets_since_missing_ = 0;
  } else if (missing_ > 0 && ++packets_since_missing_ >= kMissingGrace_packets) {
    commit_missing(losses);
  }
}

void StreamTracker::commit_missing(frame::LossCounters& losses) noexcept {
  losses.network_gap_packets += static_cast<std::uint64_t>(std::max<std::int64_t>(0, missing_));
  missing_ = 0;
  packets_since_missing_ = 0;
}

// --- The period from packet to packet ---

void StreamTracker::adopt_range(const packet::PacketAzimuths& azimuths,
                                frame::LossCounters& losses) noexcept {
  if (azimuths.nominal_period_ns == nominal_period_ns_) return;
  fix_period(losses);  // ends the measurement in the old mode
  nominal_period_ns_ = azimuths.nominal_period_ns;
  shortest_period_ns_ = azimuths.shortest_period_ns;
  longest_period_ns_ = azimuths.longest_period_ns;
  if (period_ns_ < shortest_period_ns_ || period_ns_ > longest_period_ns_) period_ns_ = 0;
}

void StreamTracker::measure_period(std::int64_t step_us, frame::LossCounters& losses) noexcept {
  if (period_ns_ == 0) {
    to_measure_[steps_++] = {step_us, explained_};
    if (steps_ == to_measure_.size()) fix_period(losses);
    return;
  }
  if (std::abs(step_us * 1000 - period_ns_) < period_ns_ / 8) {
    average_in(step_us);
    off_period_ = 0;
  } else if (++off_period_ >= kOffPeriodBeforeRemeasure) {
    period_ns_ = 0;
    off_period_ = 0;
  }
}

void StreamTracker::average_in(std::int64_t step_us) noexcept {
  // Stamps are whole microseconds and gaps last up to thousands of periods, so only the mean of
  // many steps is exact enough. Halving both sums now and then lets the mean follow the unit's
  // drift.
  averaged_us_ += step_us;
  if (++averaged_steps_ == kPeriodMean_packets) {
    averaged_us_ /= 2;
    averaged_steps_ /= 2;
  }
  period_ns_ =
      std::clamp(averaged_us_ * 1000 / averaged_steps_, shortest_period_ns_, longest_period_ns_);
}

void StreamTracker::accept_median() noexcept {
  std::array<std::int64_t, kPeriodSamples> sorted{};
  // Rejected packets in between count as arrivals.
  for (std::size_t i = 0; i < steps_; ++i) {
    sorted[i] = to_measure_[i].us / (to_measure_[i].explained + 1);
  }
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(steps_ / 2);
  std::nth_element(sorted.begin(), middle, sorted.begin() + static_cast<std::ptrdiff_t>(steps_));
  const std::int64_t median_us = *middle;
  if (median_us * 1000 < shortest_period_ns_ || median_us * 1000 > longest_period_ns_) return;
  averaged_us_ = 0;
  averaged_steps_ = 0;
  for (std::size_t i = 0; i < steps_; ++i) {
    const std::int64_t one_us = to_measure_[i].us / (to_measure_[i].explained + 1);
    if (std::abs(one_us - median_us) <= 1 + median_us / 8) average_in(one_us);
  }
}

void StreamTracker::fix_period(frame::LossCounters& losses) noexcept {
  if (missing_ > 0) commit_missing(losses);  // older than these steps
  constexpr std::size_t kFewest = 3;
  if (steps_ >= kFewest) accept_median();
  for (std::size_t i = 0; i < steps_; ++i) missing_ += missing_in(to_measure_[i]);
  missing_ = std::max<std::int64_t>(0, missing_);
  packets_since_missing_ = 0;
  steps_ = 0;
}

// --- Packets that are not placed ---

void StreamTracker::note_rejected(std::int64_t device_stamp_us) noexcept {
  if (!started_) return;
  const std::int64_t step_us = device_step_us(newest_.stamp_us, device_stamp_us);
  if (step_us > 0 && step_us <= kReorder_us) ++explained_;
}

void StreamTracker::note_stationary(std::int64_t device_stamp_us, std::int32_t azimuth_cdeg,
                                    frame::LossCounters& losses) noexcept {
  if (!started_) return;
  const std::int64_t step_us = device_step_us(newest_.stamp_us, device_stamp_us);
  if (step_us <= 0 || step_us > kOutage_us) return;
  miss(missing_in({step_us, explained_}), losses);
  explained_ = 0;
  newest_.stamp_us = device_stamp_us;
  newest_.rotor_cdeg += beams::step_cdeg(beams::wrap_cdeg(newest_.rotor_cdeg), azimuth_cdeg);
  newest_.pace_ticks = 0;
}

void StreamTracker::end_of_stream(frame::LossCounters& losses) noexcept {
  fix_period(losses);
  commit_missing(losses);
  std::fill(seen_.begin(), seen_.end(), Seen{});
  started_ = false;
  explained_ = 0;
  doubtful_packets_ = 0;
}

}  // namespace terracut::decode
