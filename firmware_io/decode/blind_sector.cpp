// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/decode/blind_sector.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "firmware_io/packet/packet_azimuths.hpp"

namespace terracut::decode {
namespace {

/// Tolerance for uneven rotation of the head and for azimuths that were rounded when sent.
constexpr std::int64_t kJitter_ticks = 5 * packet::kTicksPerCdeg;
/// If a sensor's packets begin where its view begins, rounding of azimuths makes its gaps differ by
/// at most this.
constexpr std::int64_t kRounding_ticks = 3 * packet::kTicksPerCdeg;

}  // namespace

BlindSector::Verdict BlindSector::judge(const packet::RotorInterval& head, std::int64_t packets,
                                        std::int64_t rejected, const Stride& stride) noexcept {
  Gap gap{head, packets, rejected, stride, false};
  const bool is_wide = head.ticks() >= least_ticks();
  if (!sector_.is_none()) {
    const Verdict verdict = beside_sector(gap);
    if (is_wide && !is_between(head)) remember(gap);
    return verdict;
  }
  const bool may_be_blind = is_wide && head.ticks() < sector_.revolution_ticks - least_ticks();
  if (!may_be_blind) return {head, false, packets};
  if (gaps_known_ > 0 && !follows(head)) {
    const bool is_narrower = head.ticks() < gaps_.back().head.ticks();
    if (is_between(head) && is_narrower) return {head, false, packets};
    refute();
  }
  gap.is_pending = true;
  remember(gap);
  if (sector_.is_none()) return {head, true, 0};
  return beside_sector(gap);
}

BlindSector::Verdict BlindSector::beside_sector(const Gap& gap) noexcept {
  const packet::RotorInterval blind = sector_.next(gap.head.from_ticks);
  const packet::RotorInterval common = packet::intersection(gap.head, blind);
  if (common.ticks() < least_ticks()) return {gap.head, false, gap.packets};

  move_to(common);
  if (gap.head.ticks() >= sector_.revolution_ticks) {  // an outage of several frames
    const std::int64_t lost =
        sector_.outside_ticks(gap.head) / gap.stride.mean_ticks - gap.rejected;
    return {gap.head, false, std::clamp<std::int64_t>(lost, 0, gap.packets)};
  }
  const std::int64_t before_ticks = common.from_ticks - gap.head.from_ticks;
  const std::int64_t after_ticks = gap.head.to_ticks - common.to_ticks;
  note_end(before_ticks, gap.stride, earliest_ticks_);
  note_end(after_ticks, gap.stride, latest_ticks_);
  const std::int64_t before = packets_in(before_ticks, gap.stride);
  const std::int64_t after = packets_in(after_ticks, gap.stride);
  if (before + after == 0) return {};
  const std::int64_t one_ticks = gap.stride.mean_ticks;
  return {{common.from_ticks - before * one_ticks, common.to_ticks + after * one_ticks},
          false,
          std::clamp<std::int64_t>(before + after - gap.rejected, 0, gap.packets)};
}

/// Narrows the sector to the interval `common`. Widens the tolerance at either end by what the
/// sector loses there.
void BlindSector::move_to(const packet::RotorInterval& common) noexcept {
  const packet::RotorInterval blind = sector_.next(common.from_ticks);
  const std::int64_t later_ticks = std::max<std::int64_t>(0, common.from_ticks - blind.from_ticks);
  const std::int64_t earlier_ticks = std::max<std::int64_t>(0, blind.to_ticks - common.to_ticks);
  earliest_ticks_ = later_ticks < least_ticks() ? earliest_ticks_ + later_ticks : 0;
  latest_ticks_ = earlier_ticks < least_ticks() ? latest_ticks_ + earlier_ticks : 0;
  sector_.once = common;
}

/// Records how far a gap's end lies from the sector's: less than a packet if nothing is lost.
void BlindSector::note_end(std::int64_t ticks, const Stride& stride,
                           std::int64_t& widest_ticks) noexcept {
  if (is_within_packet(ticks, stride)) widest_ticks = std::max(widest_ticks, ticks);
}

/// Returns how many packets fit between the sector's end and a gap's end, `ticks` apart.
std::int64_t BlindSector::packets_in(std::int64_t ticks, const Stride& stride) const noexcept {
  if (is_within_packet(ticks, stride)) return 0;
  const bool keeps_its_rhythm = std::max(earliest_ticks_, latest_ticks_) > kRounding_ticks;
  if (!keeps_its_rhythm) return (ticks + stride.mean_ticks / 2) / stride.mean_ticks;
  return ticks < stride.widest_ticks + kJitter_ticks ? 0
                                                     : (ticks - kJitter_ticks) / stride.mean_ticks;
}

// --- Learning ---

/// True if the newest gap was at the same azimuths a frame ago.
bool BlindSector::follows(const packet::RotorInterval& gap) const noexcept {
  const packet::RotorInterval again = packet::shifted(gaps_.back().head, sector_.revolution_ticks);
  return packet::intersection(again, gap).ticks() >= least_ticks();
}

/// True if `gap` comes before the head has returned to the azimuth of the newest known gap.
bool BlindSector::is_between(const packet::RotorInterval& gap) const noexcept {
  return gaps_known_ > 0 &&
         gap.to_ticks <= gaps_.back().head.from_ticks + sector_.revolution_ticks + least_ticks();
}

void BlindSector::remember(const Gap& gap) noexcept {
  std::rotate(gaps_.begin(), gaps_.begin() + 1, gaps_.end());
  gaps_.back() = gap;
  gaps_known_ = std::min(gaps_known_ + 1, kFramesToLearn);
  if (gaps_known_ == kFramesToLearn) learn();
}

void BlindSector::learn() noexcept {
  packet::RotorInterval common = gaps_.back().head;
  for (std::size_t i = 0; i < gaps_.size(); ++i) {
    const auto frames = static_cast<std::int64_t>(gaps_.size() - 1 - i);
    common = packet::intersection(
        common, packet::shifted(gaps_[i].head, frames * sector_.revolution_ticks));
  }
  // Nothing to learn: the sector is known already, or the gaps overlap too little.
  if (common.ticks() < sector_.once.ticks() + least_ticks()) return;
  sector_.once = common;
  earliest_ticks_ = latest_ticks_ = 0;
  // The loop leaves out the newest gap, on which the caller decides.
  for (std::size_t i = 0; i + 1 < gaps_.size(); ++i) {
    if (!std::exchange(gaps_[i].is_pending, false)) continue;
    const Verdict verdict = beside_sector(gaps_[i]);
    due_.packets += verdict.packets;
    due_.ticks += sector_.outside_ticks(verdict.lost);
  }
  gaps_.back().is_pending = false;
}

void BlindSector::refute() noexcept {
  const std::size_t first = gaps_.size() - static_cast<std::size_t>(gaps_known_);
  for (std::size_t i = first; i < gaps_.size(); ++i) {
    if (std::exchange(gaps_[i].is_pending, false)) count(gaps_[i]);
  }
  gaps_known_ = 0;
}

void BlindSector::count(const Gap& gap) noexcept {
  due_.packets += gap.packets;
  due_.ticks += gap.head.ticks();
}

// --- Packets ---

void BlindSector::pass(const packet::RotorInterval& swept) noexcept {
  if (sector_.is_none()) {
    if (gaps_known_ == 0) return;
    const std::int64_t end_ticks = gaps_.back().head.to_ticks + sector_.revolution_ticks;
    if (swept.from_ticks > end_ticks + least_ticks()) refute();
    return;
  }
  const packet::RotorInterval blind = sector_.next(swept.from_ticks);
  // This packet begins closer to the sector than any packet before it.
  const std::int64_t before_ticks = blind.from_ticks - swept.from_ticks;
  if (before_ticks <= earliest_ticks_ + kRounding_ticks) {
    earliest_ticks_ = before_ticks - kRounding_ticks - 1;
  }
  if (swept.to_ticks <= blind.from_ticks + kJitter_ticks) return;
  move_to({swept.to_ticks, blind.to_ticks});  // the blind sector begins later than was known
  if (sector_.once.ticks() >= least_ticks()) return;
  sector_.once = {};
  gaps_known_ = 0;
}

bool BlindSector::is_inside(const packet::PacketAzimuths& azimuths) const noexcept {
  if (sector_.is_none()) return false;
  const packet::RotorInterval inside =
      azimuths.sector_inside(std::int64_t{azimuths.first_cdeg()} * packet::kTicksPerCdeg);
  const packet::RotorInterval blind = sector_.next(inside.from_ticks);
  const std::int64_t slack_ticks = azimuths.widest_ticks + kJitter_ticks;
  return std::abs(inside.from_ticks - blind.from_ticks) <= slack_ticks &&
         std::abs(inside.to_ticks - blind.to_ticks) <= slack_ticks;
}

BlindSector::Verdict BlindSector::cross(std::int64_t begin_ticks,
                                        const packet::RotorInterval& inside,
                                        const Stride& stride) noexcept {
  const Verdict verdict = judge(inside, 0, 0, stride);
  // The packet was completed after the sector, so no other packet begins between its beginning and
  // the sector. It therefore begins less than a packet before the sector, near where complete
  // packets still begin; only the rounding of azimuths is tolerated.
  const packet::RotorInterval blind = sector_.next(inside.from_ticks);
  const std::int64_t before_ticks = blind.from_ticks - begin_ticks + packet::kTicksPerCdeg / 2;
  earliest_ticks_ = std::max(earliest_ticks_, before_ticks - kRounding_ticks);
  return verdict;
}

void BlindSector::fill(const packet::RotorInterval& found) noexcept {
  Gap& newest = gaps_.back();
  if (gaps_known_ == 0 || !newest.is_pending) return;
  if (packet::intersection(newest.head, found).ticks() == 0) return;
  newest.packets = std::max<std::int64_t>(0, newest.packets - 1);
  if (found.from_ticks <= newest.head.from_ticks + kJitter_ticks) {
    newest.head.from_ticks = std::max(newest.head.from_ticks, found.to_ticks);
  } else if (found.to_ticks >= newest.head.to_ticks - kJitter_ticks) {
    newest.head.to_ticks = std::min(newest.head.to_ticks, found.from_ticks);
  }
}

BlindSector::Loss BlindSector::take_due() noexcept {
  return std::exchange(due_, Loss{});
}

std::int64_t BlindSector::next_packet(std::int64_t rotor_ticks) const noexcept {
  if (sector_.is_none()) return rotor_ticks;
  const packet::RotorInterval blind = sector_.next(rotor_ticks);
  // In earlier frames no packet has begun so close to the sector's beginning.
  const bool is_last = rotor_ticks >= blind.from_ticks - earliest_ticks_ - kRounding_ticks;
  return is_last ? blind.to_ticks : rotor_ticks;
}

}  // namespace terracut::decode
