// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tests/simulation/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "firmware_io/decode/blind_sector.hpp"
#include "pipeline/status/loss_causes.hpp"

namespace terracut::simulation {
namespace {

/// Packets lost in an outage of a second or more are counted by the host's clock, not exactly.
constexpr std::uint64_t kMostLostTold = 500;
constexpr std::uint64_t kPrime = 0x100000001B3;

/// True if a fault can make a frame worse than it is without.
bool befalls_frames(FaultKind kind) noexcept {
  return kind != FaultKind::kOutletStalls && kind != FaultKind::kLabelsStall &&
         kind != FaultKind::kMonitorStalls;
}

std::int64_t longest_ns(const status::FiringToLabel& waits) noexcept {
  return std::ranges::max(waits.longest_ns);
}

std::size_t turn_of(const SensorLoop& loop, std::size_t first_place) noexcept {
  return (first_place + loop.packets_per_turn / 2) / loop.packets_per_turn % loop.turns();
}

}  // namespace

std::uint64_t hash_of(std::span<const frame::Label> labels) noexcept {
  std::uint64_t hash = labels.size();
  for (const frame::Label label : labels) {
    hash = (hash ^ static_cast<std::uint64_t>(label)) * kPrime;
  }
  return hash;
}

std::vector<std::uint64_t> labels_without_haste(const SensorLoop& loop, const BlindPlaces& blind,
                                                const ground::TurnMethodMaker& method) {
  memory::FixedMemory memory;
  run::LabelledTurns turns(loop.calibration, loop.profile, decoder_config(loop, nullptr), method,
                           memory);
  std::vector<std::uint64_t> hashes(loop.turns());
  const std::size_t sent = 4 * loop.packets.size() + loop.packets_per_turn;
  for (std::size_t n = 0; n < sent; ++n) {
    if (blind.holds(n, loop)) continue;
    SensorLoop::Packet packet = loop.packets[n % loop.packets.size()];
    const std::int64_t stamp_ns = static_cast<std::int64_t>(n) * loop.period_ns;
    set_device_stamp(packet, stamp_ns / 1000);
    turns.push({.payload = packet, .stamp_ns = stamp_ns});
    while (const frame::Frame* turn = turns.next({}, nullptr)) {
      const auto first = static_cast<std::size_t>(turn->info.first_packet_ns / loop.period_ns);
      hashes[turn_of(loop, first)] = hash_of(turns.labels());
    }
  }
  return hashes;
}

Watch::Watch(const SensorLoop& loop, const BlindPlaces& blind, const Faults& faults,
             std::span<const std::uint64_t> expected, Machine& machine, Network& network,
             LiveChain& chain)
    : loop_(loop),
      blind_(blind),
      faults_(faults),
      expected_(expected),
      machine_(machine),
      network_(network),
      chain_(chain),
      memory_bytes_(chain.memory.total_bytes()),
      stamps_are_comparable_(!has(FaultKind::kHostClock)) {}

bool Watch::has_only(std::initializer_list<FaultKind> kinds) const noexcept {
  return std::ranges::all_of(faults_, [&](const Fault& fault) {
    return std::ranges::find(kinds, fault.kind) != kinds.end() || !befalls_frames(fault.kind);
  });
}

bool Watch::has(FaultKind kind) const noexcept {
  return std::ranges::find(faults_, kind, &Fault::kind) != faults_.end();
}

void Watch::require(bool holds, const char* what) {
  if (holds || broken_) return;
  broken_ = fmt::format("{:.3f} s: {}", static_cast<double>(machine_.now_ns()) / 1e9, what);
}

void Watch::note(std::uint64_t value) noexcept {
  digest_ = (digest_ ^ value) * kPrime;
}

Watch::Counts Watch::counts() {
  (void)chain_.intake.take_if_new();
  return {.account = chain_.intake.newest_taken().account,
          .unused_labels = chain_.labels.unused(),
          .unused_points = chain_.points.unused(),
          .unused_sectors = chain_.sectors.unused(),
          .dropped_records = chain_.records.dropped()};
}

std::int64_t Watch::end_ns(const Fault& fault, const Faults& faults,
                           const SensorLoop& loop) noexcept {
  const bool befalls_packets =
      fault.kind == FaultKind::kLoss || fault.kind == FaultKind::kReorder ||
      fault.kind == FaultKind::kDuplicate || fault.kind == FaultKind::kTruncated;
  if (!befalls_packets) return fault.end_ns();
  const std::int64_t packets_ns = (fault.amount + 2) * loop.period_ns;
  std::int64_t end_ns = fault.at_ns() + packets_ns;
  for (const Fault& off : faults) {  // while the sensor is off, none comes that could be befallen
    const bool delays = off.kind == FaultKind::kSensorRestart && off.end_ns() > fault.at_ns();
    if (delays) end_ns = std::max(end_ns, off.end_ns() + packets_ns);
  }
  return end_ns;
}

bool Watch::must_be_perfect(const frame::FrameInfo& info) const {
  const auto first = network_.packet_of(info.first_packet_ns);
  const auto last = network_.packet_of(info.last_packet_ns);
  if (!first || !last) return false;
  const std::int64_t recovery_ns = turns_to_recover(blind_) * loop_.turn_ns();
  if (first->arrival_ns < recovery_ns) return false;  // the run has just begun
  return std::ranges::none_of(faults_, [&](const Fault& fault) {
    return befalls_frames(fault.kind) && fault.at_ns() < last->arrival_ns + loop_.turn_ns() &&
           end_ns(fault, faults_, loop_) + recovery_ns > first->arrival_ns;
  });
}

// --- Datagrams and memory ---

void Watch::look_after_round(std::uint64_t allocations) {
  const OffTheRecord own_memory;
  const Counts now = counts();
  const net::DatagramAccount& account = now.account;
  require(account.balances(), "the account of datagrams does not balance");
  std::uint64_t sum = account.in_doubt;
  for (const status::NamedCount& outcome : status::outcomes_of(account)) sum += outcome.count;
  require(sum == account.source.received, "the outcomes told do not add up");
  require(account.source.received + network_.waiting() == network_.truth().taken,
          "a datagram that the kernel handed over is not in the account");
  require(account.source.kernel_drops <= network_.truth().dropped,
          "more drops are told than there were");
  require(chain_.memory.total_bytes() == memory_bytes_, "memory was taken after the start");
  require(allocations == 0 || !test::allocations_are_counted(),
          "the thread with a deadline allocated memory");
}

// --- Frames ---

void Watch::judge_frames() {
  for (status::FrameRecord record; chain_.records.take(record);) {
    chain_.monitor.judge(record);
    ++frames_judged_;
    look_at_record(record);
  }
  const status::MonitorSnapshot& figures = chain_.monitor.snapshot();
  std::uint64_t levels = 0;
  for (const std::uint64_t count : figures.levels) levels += count;
  require(figures.frames == frames_judged_ && levels == frames_judged_, "frames are miscounted");
}

void Watch::look_at_record(const status::FrameRecord& record) {
  const frame::FrameInfo& info = record.info;
  const stage::SegmentationReport& report = record.segmentation;
  for (const std::uint64_t value :
       {std::uint64_t{info.number}, std::uint64_t{info.returns},
        static_cast<std::uint64_t>(info.last_packet_ns),
        static_cast<std::uint64_t>(record.labels_ns), static_cast<std::uint64_t>(record.level),
        std::uint64_t{report.ground}, std::uint64_t{record.missed}}) {
    note(value);
  }
  const bool follows = !judged_ || info.number == *judged_ + 1;
  require(follows || chain_.records.dropped() > 0, "a frame's number does not follow");
  require(!judged_ || info.number > *judged_, "a frame came twice");
  judged_ = info.number;
  require(info.returns > 0 && report.labelled() == info.returns, "a return has no label");
  const bool is_whole_cut =
      report.last_stage == stage::Stage::kMinCut && report.cut.coarse_by_budget == 0;
  require((record.level == status::Level::kFull) == is_whole_cut, "a level is not the cut's");

  require(record.run_queue_wait_ns >= 0 && record.run_queue_wait_ns <= machine_.waited_ns(),
          "a frame's wait for its core is longer than all waits");
  const std::int64_t lag_ns = record.labels_ns - info.last_packet_ns;
  const std::int64_t deadline_ns = LiveChain::kDeadline_ns;
  if (stamps_are_comparable_) {
    require(record.labels_ns <= machine_.time_of_day_ns(), "labels are older than they say");
    require(record.missed == (lag_ns > deadline_ns), "a frame's deadline is misjudged");
    require(record.level == status::Level::kFull ||
                longest_ns(record.firing_to_label) > deadline_ns - loop_.turn_ns() / 8,
            "a cut was stopped although there was time");
  }
  using enum FaultKind;
  if (info.complete && has_only({kLoss, kDuplicate, kTruncated, kCablePulled, kSensorRestart,
                                 kDeviceClock, kMotionStops, kHeadStands})) {
    require(!record.missed, "a frame is late that nothing held up but the sensor's silence");
  }
  if (has_only({kDuplicate, kGarbage, kStolenCore, kMotionStops})) {
    require(lag_ns <= LiveChain::kDeadline_ns + 2 * loop_.turn_ns() + stolen_since(info),
            "a frame is older than any that is worth its label");
  }
  if (!must_be_perfect(info)) return;
  ++perfect_;
  const frame::LossCounters& losses = info.losses;
  require(info.complete, "a frame is not complete, when all faults are long over");
  require(losses.rejected_total() == 0 && losses.network_gap_packets == 0 &&
              losses.azimuth_hole_columns == 0 && losses.clock_jumps == 0 &&
              losses.late_returns == 0 && losses.overflow_full_returns == 0,
          "a frame tells of losses, when all faults are long over");
  require(record.level == status::Level::kFull,
          "a frame is not full, when all faults are long over");
  require(!record.missed && longest_ns(record.firing_to_label) <= deadline_ns,
          "a frame is late, when all faults are long over");
  require(report.late == 0, "returns came late, when all faults are long over");
  require(info.deskew.state == frame::DeskewState::kDone,
          "a frame is not deskewed, when all faults are long over");
}

bool Watch::may_seem_blind() const noexcept {
  int losses = 0;
  std::int64_t since_ns = 0;
  for (const Fault& fault : faults_) {
    if (fault.kind != FaultKind::kLoss && fault.kind != FaultKind::kTruncated) continue;
    if (fault.at_ns() > since_ns + loop_.turn_ns()) losses = 0;
    since_ns = std::max(since_ns, end_ns(fault, faults_, loop_));
    if (++losses == decode::BlindSector::kFramesToLearn) return true;
  }
  return false;
}

std::int64_t Watch::stolen_since(const frame::FrameInfo& info) const noexcept {
  const auto last = network_.packet_of(info.last_packet_ns);
  std::int64_t stolen_ns = 0;
  for (const Fault& fault : faults_) {
    if (fault.kind != FaultKind::kStolenCore || !last) continue;
    const std::int64_t from_ns = std::max(fault.at_ns(), last->arrival_ns);
    stolen_ns += std::max<std::int64_t>(0, fault.end_ns() - from_ns);
  }
  return stolen_ns;
}

void Watch::take_labels() {
  for (live::FramePool<frame::Label>::Frame frame; chain_.labels.take(frame);) {
    const frame::FrameInfo& info = frame.record.info;
    const bool follows = !labelled_ || info.number == *labelled_ + 1;
    require(follows || chain_.labels.unused() > 0, "labels of a frame are missing");
    labelled_ = info.number;
    ++labels_taken_;
    require(frame.items.size() == info.returns, "labels are not as many as returns");
    require(std::ranges::find(frame.items, frame::Label::kNone) == frame.items.end(),
            "a return has the label none");
    const std::uint64_t hash = hash_of(frame.items);
    note(hash);
    if (must_be_perfect(info)) {
      const std::size_t turn = turn_of(loop_, network_.packet_of(info.first_packet_ns)->place);
      require(hash == expected_[turn], "labels are not those of the same packets without haste");
      ++compared_;
    }
    chain_.labels.give_back(true);
  }
}

void Watch::take_points() {
  const auto take_sectors = [&] {
    for (live::SectorPool::Frame sector; chain_.sectors.take(sector);) {
      const points::SectorRecord& record = sector.record;
      require(record.frame >= sectors_.frame, "a sector came after its frame");
      if (record.frame != sectors_.frame) sectors_ = {.frame = record.frame};
      const std::uint64_t unused = chain_.sectors.unused();
      const bool follows = record.first_return == sectors_.next_return;
      require(follows || unused > 0, "returns are in no sector, and not counted");
      sectors_.next_return = record.first_return + static_cast<std::uint32_t>(sector.items.size());
      sectors_.longest_ns =
          std::max(sectors_.longest_ns, record.labels_ns - record.first_packet_ns);
      require(std::ranges::find(sector.items, frame::Label::kNone, &points::LabelledPoint::label) ==
                  sector.items.end(),
              "a point of a sector has no label");
      if (stamps_are_comparable_) {
        require(record.first_packet_ns <= record.last_packet_ns &&
                    record.last_packet_ns <= record.labels_ns &&
                    record.labels_ns <= machine_.time_of_day_ns(),
                "a sector's times are in no order");
      }
      note(record.first_return);
      chain_.sectors.give_back(true);
    }
  };
  take_sectors();
  for (live::FramePool<points::LabelledPoint>::Frame frame; chain_.points.take(frame);) {
    take_sectors();
    const status::FrameRecord& record = frame.record;
    require(frame.items.size() == record.info.returns, "points are not as many as returns");
    if (sectors_.frame == record.info.number && chain_.sectors.unused() == 0) {
      require(sectors_.next_return == record.info.returns, "sectors are not the whole frame");
      require(sectors_.longest_ns <= longest_ns(record.firing_to_label),
              "a sector was later than is told of its frame");
    }
    chain_.points.give_back(true);
  }
}

void Watch::tell_motion() {
  (void)chain_.motion.add(
      {.stamp_ns = machine_.time_of_day_ns(), .speed_mps = 10, .yaw_rate_radps = 0.1});
}

// --- After all faults ---

void Watch::begin_of_quiet() {
  quiet_ = counts();
  quiet_began_ns_ = machine_.now_ns();
  perfect_before_quiet_ = perfect_;
}

void Watch::look_at_truth(const net::DatagramAccount& account) {
  using enum FaultKind;
  const Network::Truth& truth = network_.truth();
  const auto rejected = [&](frame::Reject reason) {
    return account.losses.rejected[static_cast<std::size_t>(reason)];
  };
  require(account.source.foreign == truth.foreign, "datagrams of another sender are miscounted");
  if (account.let_go == 0) {
    require(rejected(frame::Reject::kWrongSize) == truth.of_wrong_size,
            "datagrams of wrong size are miscounted");
  }
  if (has_only({kLoss, kDuplicate, kTruncated, kGarbage, kOtherSender, kStolenCore, kSlowWork,
                kMotionStops}) &&
      blind_.count == 0) {
    if (account.let_go == 0) {
      require(rejected(frame::Reject::kRepeated) == truth.repeated, "repeats are miscounted");
    }
    // Where packets were let go, the stream begins anew: what the kernel dropped there is told as
    // its drops alone.
    const std::uint64_t told_lost = account.losses.network_gap_packets;
    require(told_lost <= truth.packets_lost, "packets are told lost that were not");
    if (truth.packets_lost < kMostLostTold && account.let_go == 0 && !may_seem_blind()) {
      require(told_lost == truth.packets_lost, "packets were lost that are not told");
    }
  }
  if (has_only({kDuplicate, kGarbage, kBurst, kHostClock, kMotionStops}) && account.let_go == 0 &&
      truth.dropped == 0) {
    require(account.losses.rejected_total() == truth.repeated + truth.of_wrong_size,
            "packets are refused although none is bad");
  }
}

void Watch::look_at_end() {
  chain_.labeller->finish();
  judge_frames();
  take_labels();
  take_points();
  const Counts now = counts();
  const net::DatagramAccount &then = quiet_.account, &end = now.account;
  require(end.source.kernel_drops == network_.truth().dropped, "drops of the kernel are not told");
  require(end.in_doubt == 0 && then.in_doubt == 0, "packets stay in doubt");
  require(end.decoded - then.decoded == end.source.received - then.source.received,
          "not every packet is decoded, when all faults are long over");
  require(end.losses.network_gap_packets == then.losses.network_gap_packets,
          "packets are told lost, when all faults are long over");
  require(now.unused_labels == quiet_.unused_labels && now.unused_points == quiet_.unused_points &&
              now.unused_sectors == quiet_.unused_sectors &&
              now.dropped_records == quiet_.dropped_records,
          "outputs are left out, when all faults are long over");
  look_at_truth(end);
  const std::int64_t turns = (machine_.now_ns() - quiet_began_ns_) / loop_.turn_ns();
  require(static_cast<std::int64_t>(perfect_ - perfect_before_quiet_) >= turns - 2,
          "frames do not come, when all faults are long over");
  for (const std::uint64_t value :
       {end.source.received, end.source.kernel_drops, end.let_go, end.decoded,
        end.losses.rejected_total(), end.losses.network_gap_packets}) {
    note(value);
  }
}

}  // namespace terracut::simulation
