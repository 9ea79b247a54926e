// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "live_threads.hpp"

#include <chrono>
#include <future>
#include <utility>

#include "rt/page_faults.hpp"

namespace terracut::cli {
namespace {

constexpr std::int64_t kPatience_ns = 100'000'000;
constexpr std::chrono::microseconds kGathering{1000};

/// Waits on purpose.
void gather() noexcept {
  rt::trusted_call([]() noexcept { std::this_thread::sleep_for(kGathering); });
}

}  // namespace

LiveThreads::LiveThreads(const LiveOptions& options, std::int64_t turn_ns, LiveChain& chain,
                         LiveSource& source, Events events, firmware_io::FlightRecorder* recorder,
                         rt::FixedMemory& memory)
    : options_(options),
      deadline_ns_(static_cast<std::int64_t>(options.deadline_ms * 1e6)),
      turn_ns_(turn_ns),
      chain_(chain),
      source_(source),
      events_(std::move(events)),
      recorder_(recorder),
      told_table_(memory),
      exchange_(chain.decoder.images()),
      segmented_(memory),
      skipped_(memory),
      near_ground_(memory) {
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
  Receiver receiver({.deadline_ns = deadline_ns_, .turn_ns = turn_ns_}, chain_, source_,
                    {.turns = &exchange_,
                     .turn_ready = &events_.turn_ready,
                     .skipped = &skipped_,
                     .intake = &intake_,
                     .recorder = recorder_,
                     .told_table = options_.capture.calibration.empty() ? nullptr : &told_table_},
                    {}, rt::RunQueueWait::of_this_thread());
  receive_turns(receiver);
}

void LiveThreads::receive_turns(Receiver& receiver) noexcept {
  const rt::PageFaults at_start = rt::PageFaults::of_this_thread();
  while (!stop_.load(std::memory_order_relaxed)) {
    const Receiver::Round round = receiver.turn_round(kPatience_ns);
    if (round.turns > 0) receive_state_.note_faults(at_start);
    if (round.may_gather) gather();
  }
  receiver.finish();
}

void LiveThreads::segment() noexcept {
  Segmenter segmenter(deadline_ns_, chain_, exchange_,
                      {.timings = &segmented_,
                       .labels = labels(),
                       .points = points(),
                       .points_ready = &events_.points_ready,
                       .near_ground = &near_ground_},
                      {}, rt::RunQueueWait::of_this_thread());
  segment_turns(segmenter);
}

void LiveThreads::segment_turns(Segmenter& segmenter) noexcept {
  const rt::PageFaults at_start = rt::PageFaults::of_this_thread();
  while (!stop_.load(std::memory_order_relaxed)) {
    (void)events_.turn_ready.wait(-1, kPatience_ns);
    if (segmenter.turn_round()) segment_state_.note_faults(at_start);
  }
}

const Intake& LiveThreads::intake() noexcept {
  (void)intake_.take_if_new();
  return intake_.newest_taken();
}

}  // namespace terracut::cli
