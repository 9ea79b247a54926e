// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace terracut::queues {

/// Passes values between threads without a deadline: it locks and allocates. Any thread.
template <class T>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t most) : most_(most) {}

  /// Pushes a value. False if the queue is full or closed.
  bool push(T value) {
    const std::scoped_lock lock(mutex_);
    if (closed_ || values_.size() >= most_) return false;
    values_.push_back(std::move(value));
    news_.notify_one();
    return true;
  }
  /// Pushes a value. If the queue is full, removes its oldest value and returns it.
  std::optional<T> push_out(T value) {
    const std::scoped_lock lock(mutex_);
    if (closed_) return value;
    std::optional<T> oldest;
    if (values_.size() >= most_) {
      oldest = std::move(values_.front());
      values_.pop_front();
    }
    values_.push_back(std::move(value));
    news_.notify_one();
    return oldest;
  }

  /// Returns the oldest value; nothing when the time is up, or at once if the queue is empty and
  /// closed.
  std::optional<T> pop(std::chrono::nanoseconds patience) {
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, patience, [&] { return closed_ || !values_.empty(); });
    if (values_.empty()) return std::nullopt;
    std::optional<T> oldest = std::move(values_.front());
    values_.pop_front();
    return oldest;
  }

  /// Refuses further values; those already in the queue can still be popped.
  void close() {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
    news_.notify_all();
  }
  /// True if closed and empty: pop() will return nothing any more.
  [[nodiscard]] bool is_over() const {
    const std::scoped_lock lock(mutex_);
    return closed_ && values_.empty();
  }

 private:
  const std::size_t most_;
  mutable std::mutex mutex_;
  std::condition_variable news_;
  std::deque<T> values_;
  bool closed_ = false;
};

}  // namespace terracut::queues
