// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/publish/retried_sink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "rt/caught.hpp"

namespace terracut::publish {
namespace {

/// Adds counts of the same name.
void add(std::vector<status::NamedCount>& counts, const std::vector<status::NamedCount>& more) {
  for (const status::NamedCount& each : more) {
    const auto same = std::ranges::find_if(counts, [&](const status::NamedCount& count) {
      return count.name.view() == each.name.view();
    });
    if (same == counts.end()) {
      counts.push_back(each);
    } else {
      same->count += each.count;
    }
  }
}

}  // namespace

RetriedSink::RetriedSink(Config config)
    : name_(std::move(config.name)),
      queue_frames_(config.queue_frames),
      inner_(std::move(config.inner)),
      wants_sectors_(config.wants_sectors),
      is_to_be_whole_(config.is_to_be_whole) {}

FrameSink* RetriedSink::inner() {
  const Inner* const opened = inner_.get();
  const std::scoped_lock lock(mutex_);
  shown_ = opened == nullptr ? nullptr : opened->get();
  return shown_;
}

void RetriedSink::give_up(const Error& error) {
  {
    const std::scoped_lock lock(mutex_);
    add(before_, shown_->losses());
    shown_ = nullptr;
  }
  inner_.give_up(error);
}

template <class Put>
bool RetriedSink::passed_on(Put&& put) {
  FrameSink* const sink = inner();
  if (sink == nullptr) return false;
  const Status taken = rt::caught([&] { return put(*sink); });
  if (!taken) give_up(taken.error());
  return taken.has_value();
}

Status RetriedSink::put(const LabelledFrame& frame) {
  if (passed_on([&](FrameSink& sink) { return sink.put(frame); })) return {};
  const std::scoped_lock lock(mutex_);
  ++while_closed_;
  return {};
}

Status RetriedSink::put_sector(const LabelledSector& sector) {
  if (passed_on([&](FrameSink& sink) { return sink.put_sector(sector); })) return {};
  const std::scoped_lock lock(mutex_);
  ++sectors_while_closed_;
  return {};
}

Status RetriedSink::put_figures(const status::MonitorSnapshot& figures) {
  (void)passed_on([&](FrameSink& sink) { return sink.put_figures(figures); });
  return {};
}

Status RetriedSink::finish() {
  Status finished;
  if (const Inner* const opened = inner_.opened()) finished = (*opened)->finish();
  const std::scoped_lock lock(mutex_);
  if (!finished || while_closed_ == 0 || !is_to_be_whole_) return finished;
  return fail(ErrorCode::kWriteFailed,
              fmt::format("{} frames are missing in what was written", while_closed_));
}

std::vector<status::NamedCount> RetriedSink::losses() const {
  const std::scoped_lock lock(mutex_);
  std::vector<status::NamedCount> losses{
      {{fmt::format("{}_frames_while_closed", name_)}, while_closed_}};
  if (wants_sectors_) {
    losses.push_back({{fmt::format("{}_sectors_while_closed", name_)}, sectors_while_closed_});
  }
  add(losses, before_);
  if (shown_ != nullptr) add(losses, shown_->losses());
  return losses;
}

}  // namespace terracut::publish
