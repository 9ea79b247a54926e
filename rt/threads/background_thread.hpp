// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <thread>
#include <utility>

namespace terracut::threads {

/// A thread without a deadline, for work that may wait for a disk, and whose end must not be waited
/// for longer than one cares to: a disk that does not answer holds its thread for ever.
class BackgroundThread {
 public:
  explicit BackgroundThread(std::function<void()> work) {
    std::promise<void> ended;
    ended_ = ended.get_future();
    thread_ = std::jthread([work = std::move(work), ended = std::move(ended)]() mutable {
      work();
      ended.set_value();
    });
  }

  /// Whether the work came to its end meanwhile.
  [[nodiscard]] bool ends_within(std::chrono::milliseconds patience) {
    return ended_.wait_for(patience) == std::future_status::ready;
  }

 private:
  std::future<void> ended_;
  std::jthread thread_;
};

}  // namespace terracut::threads
