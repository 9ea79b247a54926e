// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "live_threads.hpp"

#include <algorithm>
#include <future>
#include <utility>

#include "rt/page_faults.hpp"
#include "rt/scheduler_times.hpp"
#include "rt/stolen_time.hpp"
#include "rt/thread_setup.hpp"

namespace terracut::cli {
namespace {

using firmware_io::FrameInfo;

constexpr std::int64_t kPatience_ns = 100'000'000;

rt::ThreadWish wish(std::string name, int priority, std::optional<int> core) {
  rt::ThreadWish wish{.name = std::move(name), .scheduling = {}, .core = core};
  if (priority > 0) wish.scheduling = rt::FifoScheduling{priority};
  return wish;
}

void publish(LiveThreads::Faults& faults, const rt::PageFaults& at_start) noexcept {
  const rt::PageFaults now = rt::PageFaults::of_this_thread().since(at_start);
  faults.minor.store(now.minor, std::memory_order_relaxed);
  faults.major.store(now.major, std::memory_order_relaxed);
}

}  // namespace

LiveThreads::LiveThreads(const LiveOptions& options, PacketChain& chain,
                         firmware_io::UdpSource& source, firmware_io::WakeEvent ready,
                         firmware_io::FlightRecorder* recorder, rt::FixedMemory& memory)
    : options_(options),
      chain_(chain),
      source_(source),
      ready_(std::move(ready)),
      recorder_(recorder),
      exchange_(chain.decoder.images()),
      ladder_(static_cast<std::int64_t>(options.deadline_ms * 1e6)),
      segmented_("frame timings", kTimings, memory),
      skipped_("frame timings", kTimings, memory),
      full_slots_("label slots", kLabelSlots, memory),
      free_slots_("label slots", kLabelSlots, memory) {
  for (std::uint32_t slot = 0; slot < kLabelSlots; ++slot) {
    label_slots_[slot].labels =
        memory.take<pipeline::Label>("label slots", chain.decoder.return_capacity());
    (void)free_slots_.try_push(slot);
  }
}

std::vector<rt::Grant> LiveThreads::start() {
  std::promise<std::vector<rt::Grant>> receive_granted, segment_granted;
  const auto set_up = [](const rt::ThreadWish& wanted, std::promise<std::vector<rt::Grant>>& told) {
    auto granted = rt::set_up_this_thread(wanted);
    told.set_value(granted ? *std::move(granted) : std::vector<rt::Grant>{});
  };
  const RealtimeOptions& wanted = options_.realtime;
  segment_thread_ = std::jthread([&] {
    set_up(wish("tc-segment", wanted.segment_priority, wanted.segment_core), segment_granted);
    segment();
  });
  receive_thread_ = std::jthread([&] {
    set_up(wish("tc-receive", wanted.receive_priority, wanted.receive_core), receive_granted);
    receive();
  });
  std::vector<rt::Grant> grants = receive_granted.get_future().get();
  for (rt::Grant& grant : segment_granted.get_future().get()) grants.push_back(std::move(grant));
  return grants;
}

void LiveThreads::stop() {
  stop_ = true;
  source_.wake();
  if (receive_thread_.joinable()) receive_thread_.join();
  ready_.wake();
  if (segment_thread_.joinable()) segment_thread_.join();
}

void LiveThreads::receive() noexcept {
  const rt::PageFaults at_start = rt::PageFaults::of_this_thread();
  std::int64_t spent_ns = rt::thread_cpu_ns();
  std::int64_t newest_packet_ns = 0;
  const auto on_frame = [&](const FrameInfo& info,
                            pipeline::RangeImage& image) noexcept -> pipeline::RangeImage* {
    FrameExchange::Turn turn{&image, info, {}, chain_.decoder.losses()};
    const std::int64_t now_ns = rt::thread_cpu_ns();
    turn.timing.number = info.number;
    turn.timing.returns = info.returns;
    turn.timing.first_packet_ns = info.first_packet_ns;
    turn.timing.last_packet_ns = info.last_packet_ns;
    turn.timing.closing_packet_ns = newest_packet_ns;
    turn.timing.decode_cpu_ns = now_ns - spent_ns;
    turn.timing.handed_over_ns = rt::realtime_ns();
    spent_ns = now_ns;
    pipeline::RangeImage* next =
        exchange_.hand_over(turn, [this](const FrameExchange::Turn& skipped) noexcept {
          rt::FrameTiming timing = skipped.timing;
          timing.rung = rt::Rung::kSkipped;
          timing.labels_ns = rt::realtime_ns();
          (void)skipped_.try_push(timing);
        });
    ready_.wake();
    publish(receive_faults_, at_start);
    return next;
  };
  while (!stop_.load(std::memory_order_relaxed)) {
    const auto datagrams = source_.receive(kPatience_ns);
    for (const firmware_io::Datagram& datagram : datagrams) {
      newest_packet_ns = datagram.stamp_ns;
      if (recorder_ != nullptr) recorder_->add(datagram);
      chain_.decoder.decode(datagram, on_frame);
    }
    packets_.fetch_add(datagrams.size(), std::memory_order_relaxed);
    kernel_drops_.store(source_.counters().kernel_drops, std::memory_order_relaxed);
  }
}

void LiveThreads::segment() noexcept {
  const rt::PageFaults at_start = rt::PageFaults::of_this_thread();
  const rt::SchedulerTimes scheduler = rt::SchedulerTimes::of_this_thread();
  const auto stolen = rt::StolenTime::open();
  const auto stolen_ns = [&] { return stolen ? stolen->read_ns().value_or(0) : 0; };
  rt::SchedulerReading before = scheduler.read();
  std::int64_t stolen_before_ns = stolen_ns();
  while (!stop_.load(std::memory_order_relaxed)) {
    (void)ready_.wait(-1, kPatience_ns);
    FrameExchange::Turn* turn = exchange_.take_if_new();
    if (turn == nullptr) continue;
    segment_turn(*turn);
    const rt::SchedulerReading now = scheduler.read();
    const std::int64_t stolen_now_ns = stolen_ns();
    turn->timing.run_queue_wait_ns = now.since(before).waited_ns;
    turn->timing.steal_ns = stolen_now_ns - stolen_before_ns;
    before = now;
    stolen_before_ns = stolen_now_ns;
    losses_.publish(turn->losses);
    (void)segmented_.try_push(turn->timing);
    publish(segment_faults_, at_start);
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
  clock_.begin();
  const pipeline::SegmentationReport report =
      chain_.segmenter.segment(*turn.image, ladder_.budget(), &clock_);
  timing.rung = DeadlineLadder::rung_of(report);
  ladder_.end(clock_.times());
  pass_on_labels(timing.number);
  timing.labels_ns = rt::realtime_ns();
  timing.segment_cpu_ns = rt::thread_cpu_ns() - begun_cpu_ns;
  std::copy(clock_.times().stage_ns.begin(), clock_.times().stage_ns.end(),
            timing.stage_cpu_ns.begin());
  timing.cut_operations =
      static_cast<std::uint64_t>(report.cut.persistency_ops + report.cut.greedy_push_ops +
                                 report.cut.boykov_kolmogorov_ops + report.cut.push_relabel_ops);
}

void LiveThreads::pass_on_labels(std::uint32_t number) noexcept {
  if (options_.labels.empty()) return;
  std::uint32_t slot = 0;
  if (!free_slots_.try_pop(slot)) {
    labels_dropped_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  const auto labels = chain_.segmenter.labels();
  LabelSlot& filled = label_slots_[slot];
  filled.number = number;
  filled.count = labels.size();
  std::copy(labels.begin(), labels.end(), filled.labels.begin());
  (void)full_slots_.try_push(slot);  // as many places as slots
}

bool LiveThreads::take_labels(Labels& labels) noexcept {
  if (!full_slots_.try_pop(taken_slot_)) return false;
  const LabelSlot& slot = label_slots_[taken_slot_];
  labels = {slot.number, slot.labels.first(slot.count)};
  return true;
}

void LiveThreads::give_back() noexcept {
  (void)free_slots_.try_push(taken_slot_);
}

firmware_io::LossCounters LiveThreads::losses() noexcept {
  (void)losses_.take_if_new();
  firmware_io::LossCounters losses = losses_.newest_taken();
  losses.kernel_drops = kernel_drops_.load(std::memory_order_relaxed);
  return losses;
}

}  // namespace terracut::cli
