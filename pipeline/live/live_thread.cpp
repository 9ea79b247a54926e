// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/live/live_thread.hpp"

#include <algorithm>
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

LiveThread::LiveThread(const Config& config, run::LabelledTurns& turns, net::LiveSource& source,
                       threads::WakeEvent points_ready, recorder::FlightRecorder* recorder,
                       memory::FixedMemory& memory)
    : config_(config),
      turns_(turns),
      source_(source),
      points_ready_(std::move(points_ready)),
      recorder_(recorder),
      told_table_(memory),
      records_(memory),
      near_ground_(memory) {
  const std::size_t capacity = turns.decoder().return_capacity();
  if (config.keeps_labels) labels_.emplace("label slots", kLabelSlots, capacity, memory);
  if (config.keeps_points) {
    points_.emplace("point slots", kPointSlots, capacity, memory,
                    config.keeps_heights ? FramePool<points::LabelledPoint>::Heights::kKept
                                         : FramePool<points::LabelledPoint>::Heights::kLeftOut);
  }
  if (!config.keeps_points && !config.keeps_sectors) return;
  reader_ = turns.decoder().make_reader(memory);
  if (!config.keeps_sectors) return;
  // A turn that follows no other one is labelled at once, so there is room for a whole one.
  const std::size_t returns_of_tile = reader_->rows().size() * frame::kTileFirings;
  sectors_.emplace(
      "sector slots", capacity / returns_of_tile, returns_of_tile, memory,
      config.keeps_heights ? SectorPool::Heights::kKept : SectorPool::Heights::kLeftOut);
}

std::vector<threads::Grant> LiveThread::start() {
  std::promise<std::vector<threads::Grant>> granted;
  std::future<std::vector<threads::Grant>> grants = granted.get_future();
  thread_ = std::jthread([this, granted = std::move(granted)]() mutable {
    granted.set_value(state_.set_up(config_.thread));
    work();
  });
  return grants.get();
}

void LiveThread::stop() {
  stop_ = true;
  if (!thread_.joinable()) return;
  source_.wake();
  thread_.join();
}

void LiveThread::work() noexcept {
  Labeller labeller({.deadline_ns = config_.deadline_ns,
                     .frame_period_ns = config_.frame_period_ns,
                     .gathering = {.frame_period_ns = config_.frame_period_ns,
                                   .longest_ns = config_.longest_gathering_ns,
                                   .room_packets = source_.room_packets()}},
                    turns_, source_,
                    {.records = &records_,
                     .intake = &intake_,
                     .labels = labels(),
                     .points = points(),
                     .sectors = sectors(),
                     .points_ready = &points_ready_,
                     .reader = reader_.get(),
                     .near_ground = &near_ground_,
                     .recorder = recorder_,
                     .told_table = config_.compares_tables ? &told_table_ : nullptr},
                    {}, measure::RunQueueWait::of_this_thread());
  label(labeller);
}

void LiveThread::label(Labeller& labeller) noexcept {
  const measure::PageFaults at_start = measure::PageFaults::of_this_thread();
  // A sensor that falls silent is noticed before its last labels are due.
  const std::int64_t longest_wait_ns = std::min(config_.deadline_ns / 4, kLongestWait_ns);
  while (!stop_.load(std::memory_order_relaxed)) {
    const Labeller::Round round = labeller.work_round(longest_wait_ns);
    if (round.frames > 0) state_.note_faults(at_start);
    if (round.gathering_ns > 0) gather(round.gathering_ns);
  }
  labeller.finish();
}

const status::InputState& LiveThread::intake() noexcept {
  (void)intake_.take_if_new();
  return intake_.newest_taken();
}

}  // namespace terracut::live
