// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/live/live_threads.hpp"

#include <chrono>
#include <future>
#include <utility>

#include "rt/measure/page_faults.hpp"

namespace terracut::live {
namespace {

constexpr std::int64_t kLongestWait_ns = 100'000'000;

/// Lets packets gather by waiting, so that one call receives many of them.
void gather(std::int64_t time_ns) noexcept {
  threads::trusted_call(
      [&]() noexcept { std::this_thread::sleep_for(std::chrono::nanoseconds(time_ns)); });
}

}  // namespace

LiveThreads::LiveThreads(const Config& config, LivePipeline& pipeline, net::LiveSource& source,
                         Events events, recorder::FlightRecorder* recorder,
                         memory::FixedMemory& memory)
    : config_(config),
      pipeline_(pipeline),
      source_(source),
      events_(std::move(events)),
      recorder_(recorder),
      told_table_(memory),
      exchange_(pipeline.decoder.buffers()),
      segmented_(memory),
      skipped_(memory),
      near_ground_(memory) {
  const std::size_t capacity = pipeline.decoder.return_capacity();
  if (config.keeps_labels) labels_.emplace("label slots", kLabelSlots, capacity, memory);
  if (config.keeps_points) points_.emplace("point slots", kPointSlots, capacity, memory);
}

Expected<LiveThreads::Events> LiveThreads::Events::make() {
  auto frame_ready = threads::WakeEvent::make();
  if (!frame_ready) return tl::unexpected(frame_ready.error());
  auto points_ready = threads::WakeEvent::make();
  if (!points_ready) return tl::unexpected(points_ready.error());
  return Events{*std::move(frame_ready), *std::move(points_ready)};
}

std::vector<threads::Grant> LiveThreads::start() {
  using Grants = std::vector<threads::Grant>;
  std::promise<Grants> receive_granted, segment_granted;  // each thread reports what it was granted
  std::future<Grants> receive_grants = receive_granted.get_future();
  std::future<Grants> segment_grants = segment_granted.get_future();
  segment_thread_ = std::jthread([this, granted = std::move(segment_granted)]() mutable {
    granted.set_value(segment_state_.set_up(config_.segment));
    segment();
  });
  receive_thread_ = std::jthread([this, granted = std::move(receive_granted)]() mutable {
    granted.set_value(receive_state_.set_up(config_.receive));
    receive();
  });
  Grants grants = receive_grants.get();
  for (threads::Grant& grant : segment_grants.get()) grants.push_back(std::move(grant));
  return grants;
}

void LiveThreads::stop() {
  stop_ = true;
  if (receive_thread_.joinable()) {
    source_.wake();
    receive_thread_.join();
  }
  if (segment_thread_.joinable()) {
    events_.frame_ready.wake();
    segment_thread_.join();
  }
}

void LiveThreads::receive() noexcept {
  Receiver receiver({.deadline_ns = config_.deadline_ns,
                     .gathering = {.frame_period_ns = config_.frame_period_ns,
                                   .longest_ns = config_.longest_gathering_ns,
                                   .room_packets = source_.room_packets()}},
                    pipeline_, source_,
                    {.frames = &exchange_,
                     .frame_ready = &events_.frame_ready,
                     .skipped = &skipped_,
                     .intake = &intake_,
                     .recorder = recorder_,
                     .told_table = config_.compares_tables ? &told_table_ : nullptr},
                    {}, measure::RunQueueWait::of_this_thread());
  receive_frames(receiver);
}

void LiveThreads::receive_frames(Receiver& receiver) noexcept {
  const measure::PageFaults at_start = measure::PageFaults::of_this_thread();
  while (!stop_.load(std::memory_order_relaxed)) {
    const Receiver::Round round = receiver.work_round(kLongestWait_ns);
    if (round.frames > 0) receive_state_.note_faults(at_start);
    if (round.gathering_ns > 0) gather(round.gathering_ns);
  }
  receiver.finish();
}

void LiveThreads::segment() noexcept {
  Segmenter segmenter(config_.deadline_ns, pipeline_, exchange_,
                      {.records = &segmented_,
                       .labels = labels(),
                       .points = points(),
                       .points_ready = &events_.points_ready,
                       .near_ground = &near_ground_},
                      {}, measure::RunQueueWait::of_this_thread());
  segment_frames(segmenter);
}

void LiveThreads::segment_frames(Segmenter& segmenter) noexcept {
  const measure::PageFaults at_start = measure::PageFaults::of_this_thread();
  while (!stop_.load(std::memory_order_relaxed)) {
    (void)events_.frame_ready.wait(-1, kLongestWait_ns);
    if (segmenter.work_round()) segment_state_.note_faults(at_start);
  }
}

const status::InputState& LiveThreads::intake() noexcept {
  (void)intake_.take_if_new();
  return intake_.newest_taken();
}

}  // namespace terracut::live
