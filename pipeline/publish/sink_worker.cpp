// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/publish/sink_worker.hpp"

#include <string>
#include <utility>

namespace terracut::publish {

SinkWorker::SinkWorker(std::unique_ptr<FrameSink> sink, WhenFull when_full, OnFailure on_failure)
    : sink_(std::move(sink)),
      when_full_(when_full),
      on_failure_(std::move(on_failure)),
      thread_([this] { work(); },
              [this](std::string_view why) {
                fail({ErrorCode::kCapacityExceeded, std::string(why)});
              }) {}

void SinkWorker::put(SharedFrame frame) {
  std::unique_lock lock(mutex_);
  if (when_full_ == WhenFull::kWait) {
    went_.wait(lock, [this] { return failure_ || frames_.size() < sink_->queue_frames(); });
  } else if (frames_.size() >= sink_->queue_frames()) {
    frames_.pop_front();
    ++left_out_;
  }
  if (failure_) {
    ++left_out_;
    return;
  }
  frames_.push_back(std::move(frame));
  lock.unlock();
  came_.notify_one();
}

void SinkWorker::put_sector(SharedSector sector) {
  {
    const std::scoped_lock lock(mutex_);
    if (failure_) {
      ++sectors_left_out_;
      return;
    }
    if (sectors_.size() == kMostSectors) {
      sectors_.pop_front();
      ++sectors_left_out_;
    }
    sectors_.push_back(std::move(sector));
  }
  came_.notify_one();
}

void SinkWorker::put_figures(std::shared_ptr<const status::MonitorSnapshot> figures) {
  {
    const std::scoped_lock lock(mutex_);
    if (failure_) return;
    figures_ = std::move(figures);
  }
  came_.notify_one();
}

void SinkWorker::begin_to_finish() {
  {
    const std::scoped_lock lock(mutex_);
    finish_ = true;
  }
  came_.notify_one();
}

std::uint64_t SinkWorker::left_out() const {
  const std::scoped_lock lock(mutex_);
  return left_out_;
}

std::uint64_t SinkWorker::sectors_left_out() const {
  const std::scoped_lock lock(mutex_);
  return sectors_left_out_;
}

std::uint64_t SinkWorker::waiting() const {
  const std::scoped_lock lock(mutex_);
  return frames_.size() + (is_working_ ? 1 : 0);
}

std::uint64_t SinkWorker::sectors_waiting() const {
  const std::scoped_lock lock(mutex_);
  return sectors_.size() + (is_working_on_sector_ ? 1 : 0);
}

std::optional<Error> SinkWorker::failure() const {
  const std::scoped_lock lock(mutex_);
  return failure_;
}

bool SinkWorker::is_sector_next() const {
  return !sectors_.empty() &&
         (frames_.empty() || sectors_.front()->record.frame <= frames_.front()->record.info.number);
}

std::optional<SinkWorker::Work> SinkWorker::next() {
  std::unique_lock lock(mutex_);
  is_working_ = is_working_on_sector_ = false;
  came_.wait(lock, [this] { return finish_ || figures_ || !frames_.empty() || !sectors_.empty(); });
  Work work{.sector = {}, .frame = {}, .figures = std::exchange(figures_, nullptr)};
  if (is_sector_next()) {
    work.sector = std::move(sectors_.front());
    sectors_.pop_front();
    is_working_on_sector_ = true;
    return work;
  }
  if (frames_.empty()) return work.figures ? std::optional(std::move(work)) : std::nullopt;
  work.frame = std::move(frames_.front());
  frames_.pop_front();
  is_working_ = true;
  lock.unlock();
  went_.notify_one();
  return work;
}

void SinkWorker::fail(const Error& error) {
  {
    const std::scoped_lock lock(mutex_);
    left_out_ += frames_.size() + (is_working_ ? 1 : 0);
    sectors_left_out_ += sectors_.size() + (is_working_on_sector_ ? 1 : 0);
    is_working_ = is_working_on_sector_ = false;
    frames_.clear();
    sectors_.clear();
    figures_ = nullptr;
    failure_ = error;
  }
  went_.notify_one();
  on_failure_(sink_->name(), error);
}

void SinkWorker::work() {
  while (const auto work = next()) {
    Status status;
    if (work->figures) status = sink_->put_figures(*work->figures);
    if (status && work->sector) status = sink_->put_sector(*work->sector);
    if (status && work->frame) status = sink_->put(*work->frame);
    if (!status) return fail(status.error());
  }
  if (const Status finished = sink_->finish(); !finished) fail(finished.error());
}

}  // namespace terracut::publish
