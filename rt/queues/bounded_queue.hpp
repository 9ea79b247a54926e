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

/// Hands values on between threads without a deadline: it locks and allocates. From any thread.
template <class T>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t most) : most_(most) {}

  /// False where it is full or closed.
  bool push(T value) {
    const std::scoped_lock lock(mutex_);
    if (closed_ || values_.size() >= most_) return false;
    values_.push_back(std::move(value));
    news_.notify_one();
    return true;
  }
  /// Makes room by the oldest, which is returned.
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

  /// The oldest; nothing when the time is up, or at once where it is empty and closed.
  std::optional<T> pop(std::chrono::nanoseconds patience) {
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, patience, [&] { return closed_ || !values_.empty(); });
    if (values_.empty()) return std::nullopt;
    std::optional<T> oldest = std::move(values_.front());
    values_.pop_front();
    return oldest;
  }

  /// What is in it can still be had; nothing more comes in.
  void close() {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
    news_.notify_all();
  }
  /// Closed and empty: pop() will not give anything any more.
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
