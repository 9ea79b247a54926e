// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "fault_injector.hpp"

#include <algorithm>
#include <utility>

namespace terracut::send {
namespace {

using Run = FaultOutcome::Run;

constexpr bool counts_packets(FaultKind kind) noexcept {
  return kind != FaultKind::kPause && kind != FaultKind::kBurst && kind != FaultKind::kClock;
}

/// True if a fault of this kind affects a packet with this stamp.
bool is_due(const FaultOutcome& outcome, FaultKind kind, std::int64_t time_ns) noexcept {
  const Fault& fault = outcome.fault;
  if (fault.kind != kind || time_ns < fault.at_ns) return false;
  if (counts_packets(kind)) return outcome.packets < fault.packets;
  return kind == FaultKind::kClock || time_ns - fault.at_ns < fault.span_ns;
}

/// Counts a packet that a fault affects. Packets come in order; a packet noted twice counts once.
void note(FaultOutcome& outcome, std::uint64_t index) {
  if (!outcome.runs.empty()) {
    Run& last = outcome.runs.back();
    if (index >= last.first && index < last.first + last.count) return;
    if (index == last.first + last.count) {
      ++last.count;
      ++outcome.packets;
      return;
    }
  }
  outcome.runs.push_back({index, 1});
  ++outcome.packets;
}

}  // namespace

bool FaultOutcome::complete() const noexcept {
  return counts_packets(fault.kind) ? packets == fault.packets : packets > 0;
}

FaultInjector::FaultInjector(FaultScript script, Sink sink, ShiftStamp shift_stamp)
    : sink_(std::move(sink)), shift_stamp_(std::move(shift_stamp)) {
  for (const Fault& fault : script) {
    outcomes_.push_back({.fault = fault});
    has_clock_fault_ = has_clock_fault_ || fault.kind == FaultKind::kClock;
  }
}

void FaultInjector::feed(const packet::Datagram& fed) {
  if (!first_ns_) first_ns_ = fed.stamp_ns;
  index_ = fed_++;
  const std::int64_t time_ns = time_of(fed);
  release_bursts(time_ns);
  insert_foreign(fed);
  if (take_away(time_ns)) return;
  packet::Datagram datagram = fed;
  edit(datagram);
  if (move_back(datagram)) return;
  pass(datagram, Origin::kSensor, index_);
  if (is_duplicated(time_ns)) pass(datagram, Origin::kSensor, index_);
  release_moved(datagram);
}

void FaultInjector::finish() {
  for (Held& held : moved_) let_go(held, held.datagram.stamp_ns);
  moved_.clear();
  for (const Held& held : bursts_) {
    packet::Datagram datagram = held.datagram;
    datagram.payload = held.bytes;
    sink_(datagram, held.origin);
  }
  bursts_.clear();
}

std::int64_t FaultInjector::time_of(const packet::Datagram& datagram) const noexcept {
  return datagram.stamp_ns - *first_ns_;
}

void FaultInjector::release_bursts(std::int64_t time_ns) {
  const auto kept = std::find_if(bursts_.begin(), bursts_.end(), [&](const Held& held) {
    return time_of(held.datagram) > time_ns;
  });
  for (auto held = bursts_.begin(); held != kept; ++held) {
    held->datagram.payload = held->bytes;
    sink_(held->datagram, held->origin);
  }
  bursts_.erase(bursts_.begin(), kept);
}

void FaultInjector::insert_foreign(const packet::Datagram& before) {
  for (FaultOutcome& outcome : outcomes_) {
    if (!is_due(outcome, FaultKind::kForeign, time_of(before))) continue;
    outcome.runs.push_back({index_, 1});
    std::vector<std::uint8_t> bytes(kForeignBytes);
    for (; outcome.packets < outcome.fault.packets; ++outcome.packets) {
      std::fill(bytes.begin(), bytes.end(), static_cast<std::uint8_t>(outcome.packets));
      packet::Datagram foreign = before;
      foreign.payload = bytes;
      pass(foreign, Origin::kForeign, index_);
    }
  }
}

bool FaultInjector::take_away(std::int64_t time_ns) {
  for (FaultOutcome& outcome : outcomes_) {
    if (is_due(outcome, FaultKind::kLoss, time_ns) || is_due(outcome, FaultKind::kPause, time_ns)) {
      note(outcome, index_);
      return true;
    }
  }
  return false;
}

/// Applies clock faults first, because truncation may remove the packet's stamp.
void FaultInjector::edit(packet::Datagram& datagram) {
  const std::int64_t time_ns = time_of(datagram);
  std::int64_t shift_ns = 0;
  FaultOutcome* cut = nullptr;  // a packet is cut only once; further cuts are for the next packets
  for (FaultOutcome& outcome : outcomes_) {
    if (is_due(outcome, FaultKind::kClock, time_ns)) shift_ns += outcome.fault.span_ns;
    if (cut == nullptr && is_due(outcome, FaultKind::kTruncate, time_ns)) cut = &outcome;
  }
  if (!has_clock_fault_ && cut == nullptr) return;
  edited_.assign(datagram.payload.begin(), datagram.payload.end());
  if (has_clock_fault_) shift_clock(time_ns, shift_ns);
  if (cut != nullptr) {
    note(*cut, index_);
    edited_.resize(edited_.size() / 2);
  }
  datagram.payload = edited_;
}

void FaultInjector::shift_clock(std::int64_t time_ns, std::int64_t shift_ns) {
  const bool shifted = shift_stamp_ && shift_stamp_(edited_, shift_ns);
  if (!shifted && shift_ns != 0) ++unshifted_;
  if (!shifted) return;
  for (FaultOutcome& outcome : outcomes_) {
    if (is_due(outcome, FaultKind::kClock, time_ns)) note(outcome, index_);
  }
}

bool FaultInjector::move_back(const packet::Datagram& datagram) {
  for (std::size_t i = 0; i < outcomes_.size(); ++i) {
    FaultOutcome& outcome = outcomes_[i];
    if (!is_due(outcome, FaultKind::kReorder, time_of(datagram)) || !outcome.runs.empty()) continue;
    outcome.runs.push_back({index_, 1});
    moved_.push_back({.datagram = datagram,
                      .bytes = {datagram.payload.begin(), datagram.payload.end()},
                      .index = index_,
                      .fault = i});
    return true;
  }
  return false;
}

bool FaultInjector::is_duplicated(std::int64_t time_ns) {
  for (FaultOutcome& outcome : outcomes_) {
    if (!is_due(outcome, FaultKind::kDuplicate, time_ns)) continue;
    note(outcome, index_);
    return true;
  }
  return false;
}

/// Passes a datagram to the sink, or holds it back until the end of the burst that it belongs to.
/// If bursts overlap, the one that ends last counts; this keeps the order.
void FaultInjector::pass(const packet::Datagram& datagram, Origin origin, std::uint64_t index) {
  const std::int64_t time_ns = time_of(datagram);
  FaultOutcome* holding = nullptr;
  std::int64_t until_ns = 0;
  for (FaultOutcome& outcome : outcomes_) {
    if (!is_due(outcome, FaultKind::kBurst, time_ns)) continue;
    const std::int64_t end_ns = outcome.fault.at_ns + outcome.fault.span_ns;
    if (holding == nullptr || end_ns > until_ns) {
      holding = &outcome;
      until_ns = end_ns;
    }
  }
  if (holding == nullptr) return sink_(datagram, origin);
  if (origin == Origin::kSensor) note(*holding, index);
  Held held{.datagram = datagram,
            .bytes = {datagram.payload.begin(), datagram.payload.end()},
            .origin = origin,
            .index = index};
  held.datagram.stamp_ns = *first_ns_ + until_ns;
  bursts_.push_back(std::move(held));
}

void FaultInjector::release_moved(const packet::Datagram& after) {
  for (Held& held : moved_) {
    FaultOutcome& outcome = outcomes_[held.fault];
    if (++outcome.packets == outcome.fault.packets) let_go(held, after.stamp_ns);
  }
  std::erase_if(moved_, [this](const Held& held) {
    const FaultOutcome& outcome = outcomes_[held.fault];
    return outcome.packets == outcome.fault.packets;
  });
}

void FaultInjector::let_go(Held& held, std::int64_t stamp_ns) {
  held.datagram.payload = held.bytes;
  held.datagram.stamp_ns = stamp_ns;
  pass(held.datagram, held.origin, held.index);
}

}  // namespace terracut::send
