// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "live_threads.hpp"

#include <algorithm>
#include <chrono>
#include <future>
#include <utility>

#include "firmware_io/sinks/labelled_points.hpp"
#include "rt/page_faults.hpp"

namespace terracut::cli {
namespace {

using firmware_io::FrameInfo;

/// Stages that are over when a turn is handed over: those before the seeds.
constexpr auto kCoarseStages = static_cast<std::uint8_t>(pipeline::Stage::kSeeds);
constexpr std::int64_t kPatience_ns = 100'000'000;
/// Waking up for every packet costs more than decoding it. After a small batch the next one is left
/// to gather in the kernel's buffer, which stamps packets and holds a thousand times as many; but
/// not where the packet may come that ends the turn.
constexpr std::size_t kWorthwhileBatch = 32;
constexpr std::chrono::microseconds kGathering{1000};

rt::FrameMotion motion_of(firmware_io::DeskewState state) noexcept {
  switch (state) {
    case firmware_io::DeskewState::kDone:
      return rt::FrameMotion::kTakenOut;
    case firmware_io::DeskewState::kNoEgoMotion:
      return rt::FrameMotion::kNoEgoMotion;
    case firmware_io::DeskewState::kOff:
      break;
  }
  return rt::FrameMotion::kNotAsked;
}

/// Waits on purpose.
void gather() noexcept {
  rt::trusted_call([]() noexcept { std::this_thread::sleep_for(kGathering); });
}

/// What the source counted since `before`.
firmware_io::ReceiveCounters since(const firmware_io::ReceiveCounters& before,
                                   firmware_io::ReceiveCounters now) noexcept {
  using Counters = firmware_io::ReceiveCounters;
  for (std::uint64_t Counters::* const count :
       {&Counters::received, &Counters::delivered, &Counters::foreign, &Counters::other_interface,
        &Counters::truncated, &Counters::no_datagram, &Counters::kernel_drops, &Counters::unstamped,
        &Counters::receive_errors, &Counters::link_losses, &Counters::reopened}) {
    now.*count -= before.*count;
  }
  return now;
}

}  // namespace

LiveThreads::LiveThreads(const LiveOptions& options, LiveChain& chain, LiveSource& source,
                         Events events, firmware_io::FlightRecorder* recorder,
                         rt::FixedMemory& memory)
    : options_(options),
      chain_(chain),
      source_(source),
      events_(std::move(events)),
      recorder_(recorder),
      exchange_(chain.decoder.images()),
      ladder_(static_cast<std::int64_t>(options.deadline_ms * 1e6)),
      segmented_("frame timings", kTimings, memory),
      skipped_("frame timings", kTimings, memory) {
  const std::size_t capacity = chain.decoder.return_capacity();
  if (!options.labels.empty()) labels_.emplace("label slots", kLabelSlots, capacity, memory);
  if (!options.stream.empty()) points_.emplace("point slots", kPointSlots, capacity, memory);
}

Expected<LiveThreads::Events> LiveThreads::Events::make() {
  auto turn_ready = firmware_io::WakeEvent::make();
  if (!turn_ready) return tl::unexpected(turn_ready.error());
  auto points_ready = firmware_io::WakeEvent::make();
  if (!points_ready) return tl::unexpected(points_ready.error());
  return Events{*std::move(turn_ready), *std::move(points_ready)};
}

std::vector<rt::Grant> LiveThreads::start() {
  using Grants = std::vector<rt::Grant>;
  std::promise<Grants> receive_granted, segment_granted;
  const RealtimeOptions& wanted = options_.realtime;
  segment_thread_ = std::jthread([&] {
    segment_granted.set_value(segment_state_.set_up(
        thread_wish("tc-segment", wanted.segment_priority, wanted.segment_core)));
    segment();
  });
  receive_thread_ = std::jthread([&] {
    receive_granted.set_value(receive_state_.set_up(
        thread_wish("tc-receive", wanted.receive_priority, wanted.receive_core)));
    receive();
  });
  Grants grants = receive_granted.get_future().get();
  for (rt::Grant& grant : segment_granted.get_future().get()) grants.push_back(std::move(grant));
  return grants;
}

void LiveThreads::stop() {
  stop_ = true;
  source_.wake();
  if (receive_thread_.joinable()) receive_thread_.join();
  events_.turn_ready.wake();
  if (segment_thread_.joinable()) segment_thread_.join();
}

void LiveThreads::receive() noexcept {
  receive_turns(rt::RunQueueWait::of_this_thread());
}

void LiveThreads::receive_turns(const rt::RunQueueWait& wait) noexcept {
  const rt::PageFaults at_start = rt::PageFaults::of_this_thread();
  std::int64_t spent_ns = rt::thread_cpu_ns();
  std::int64_t newest_packet_ns = 0;
  // Before this and the last fetching of packets: a turn's last packet came with one of the two.
  std::int64_t waited_before_fetch_ns = wait.read_ns();
  std::int64_t waited_before_last_fetch_ns = waited_before_fetch_ns;
  const auto on_frame = [&](const FrameInfo& info,
                            pipeline::RangeImage& image) noexcept -> pipeline::RangeImage* {
    FrameExchange::Turn turn{&image, info, {}, chain_.decoder.losses()};
    chain_.coarse.finish(image, chain_.planes_of(image), &coarse_clock_);
    const std::int64_t now_ns = rt::thread_cpu_ns();
    const StageTimes coarse_times = coarse_clock_.take();
    turn.timing.number = info.number;
    turn.timing.returns = info.returns;
    turn.timing.first_packet_ns = info.first_packet_ns;
    turn.timing.last_packet_ns = info.last_packet_ns;
    turn.timing.closing_packet_ns = newest_packet_ns;
    turn.timing.motion = motion_of(info.deskew.state);
    turn.timing.newest_motion_ns = info.deskew.newest_motion_ns;
    turn.timing.stages_ahead = kCoarseStages;
    std::ranges::copy(coarse_times.stage_ns, turn.timing.stage_cpu_ns.begin());
    turn.timing.segment_cpu_ns = coarse_times.sum_ns();
    turn.timing.decode_cpu_ns = now_ns - spent_ns - turn.timing.segment_cpu_ns;
    turn.timing.run_queue_wait_ns = wait.read_ns() - waited_before_last_fetch_ns;
    turn.timing.handed_over_ns = rt::realtime_ns();
    spent_ns = now_ns;
    pipeline::RangeImage* next =
        exchange_.hand_over(turn, [this](const FrameExchange::Turn& skipped) noexcept {
          rt::FrameTiming timing = skipped.timing;
          timing.rung = rt::Rung::kSkipped;
          timing.labels_ns = rt::realtime_ns();
          pass_on(skipped_, timing);
        });
    events_.turn_ready.wake();
    receive_state_.note_faults(at_start);
    return next;
  };
  // What queued up while this was being built is too old to be labelled in time, and what did not
  // fit into the kernel's buffer meanwhile is no loss of the run.
  while (!source_.receive(0).empty()) {
  }
  source_.refresh_drops();
  const firmware_io::ReceiveCounters before = source_.counters();
  firmware_io::ArrivingTurn arriving;
  while (!stop_.load(std::memory_order_relaxed)) {
    waited_before_last_fetch_ns = waited_before_fetch_ns;
    waited_before_fetch_ns = wait.read_ns();
    const auto datagrams = source_.receive(kPatience_ns);
    for (const firmware_io::Datagram& datagram : datagrams) {
      newest_packet_ns = datagram.stamp_ns;
      if (recorder_ != nullptr) recorder_->add(datagram);
      chain_.decoder.decode(datagram, on_frame);
      arriving = chain_.decoder.arriving();
      if (arriving.image == nullptr) continue;
      chain_.coarse.advance(*arriving.image, arriving.settled_columns,
                            chain_.planes_of(*arriving.image), &coarse_clock_);
    }
    intake_.publish({since(before, source_.counters()), source_.link(), newest_packet_ns});
    if (datagrams.size() < kWorthwhileBatch && !arriving.is_ending) gather();
  }
}

void LiveThreads::segment() noexcept {
  segment_turns(rt::RunQueueWait::of_this_thread(), rt::StolenTime::open());
}

void LiveThreads::segment_turns(const rt::RunQueueWait& wait,
                                const Expected<rt::StolenTime>& stolen) noexcept {
  const rt::PageFaults at_start = rt::PageFaults::of_this_thread();
  const auto stolen_ns = [&] { return stolen ? stolen->read_ns().value_or(0) : 0; };
  std::int64_t waited_before_ns = wait.read_ns();
  std::int64_t stolen_before_ns = stolen_ns();
  while (!stop_.load(std::memory_order_relaxed)) {
    (void)events_.turn_ready.wait(-1, kPatience_ns);
    FrameExchange::Turn* turn = exchange_.take_if_new();
    if (turn == nullptr) continue;
    segment_turn(*turn);
    const std::int64_t waited_now_ns = wait.read_ns();
    const std::int64_t stolen_now_ns = stolen_ns();
    turn->timing.run_queue_wait_ns += waited_now_ns - waited_before_ns;
    turn->timing.steal_ns = stolen_now_ns - stolen_before_ns;
    waited_before_ns = waited_now_ns;
    stolen_before_ns = stolen_now_ns;
    losses_.publish(turn->losses);
    pass_on(segmented_, turn->timing);
    segment_state_.note_faults(at_start);
  }
}

void LiveThreads::segment_turn(FrameExchange::Turn& turn) noexcept {
  rt::FrameTiming& timing = turn.timing;
  timing.segment_begin_ns = rt::realtime_ns();
  if (!ladder_.begin(turn.info.last_packet_ns)) {
    timing.rung = rt::Rung::kSkipped;
    timing.labels_ns = rt::realtime_ns();
    return;
  }
  const std::int64_t begun_cpu_ns = rt::thread_cpu_ns();
  const pipeline::SegmentationReport report = chain_.fine.refine(
      *turn.image, chain_.planes_of(*turn.image), ladder_.budget(), &fine_clock_);
  timing.rung = ladder_.may_hand_on() ? DeadlineLadder::rung_of(report) : rt::Rung::kSkipped;
  timing.labels_ns = rt::realtime_ns();
  const std::int64_t labelled_cpu_ns = rt::thread_cpu_ns();
  if (timing.rung != rt::Rung::kSkipped) pass_on_results(turn);
  timing.labels_ns = rt::realtime_ns();  // judged by when they were handed on
  const std::int64_t handed_on_cpu_ns = rt::thread_cpu_ns();
  timing.segment_cpu_ns += handed_on_cpu_ns - begun_cpu_ns;
  const StageTimes times = fine_clock_.take();
  ladder_.end(times, report, handed_on_cpu_ns - labelled_cpu_ns);
  for (std::size_t i = 0; i < times.stage_ns.size(); ++i) {
    timing.stage_cpu_ns[i] += times.stage_ns[i];
  }
  timing.cut_operations =
      static_cast<std::uint64_t>(report.cut.persistency_ops + report.cut.greedy_push_ops +
                                 report.cut.boykov_kolmogorov_ops + report.cut.push_relabel_ops);
}

void LiveThreads::pass_on_results(const FrameExchange::Turn& turn) noexcept {
  const auto labels = chain_.fine.labels();
  if (labels_) {
    labels_->pass_on(turn.info, turn.timing, [&](std::span<pipeline::Label> room) noexcept {
      std::copy(labels.begin(), labels.end(), room.begin());
    });
  }
  if (points_) {
    points_->pass_on(turn.info, turn.timing,
                     [&](std::span<firmware_io::LabelledPoint> room) noexcept {
                       (void)firmware_io::pack_labelled_points(*turn.image, labels, room);
                     });
    events_.points_ready.wake();
  }
}

void LiveThreads::pass_on(rt::SpscQueue<rt::FrameTiming>& queue,
                          const rt::FrameTiming& timing) noexcept {
  if (!queue.try_push(timing)) timings_dropped_.fetch_add(1, std::memory_order_relaxed);
}

const LiveThreads::Intake& LiveThreads::intake() noexcept {
  (void)intake_.take_if_new();
  return intake_.newest_taken();
}

firmware_io::LossCounters LiveThreads::losses() noexcept {
  (void)losses_.take_if_new();
  firmware_io::LossCounters losses = losses_.newest_taken();
  losses.kernel_drops = intake().counters.kernel_drops;
  return losses;
}

}  // namespace terracut::cli
