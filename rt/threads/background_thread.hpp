// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <string_view>
#include <thread>
#include <utility>

namespace terracut::threads {

/// Runs work without a deadline that may wait for a disk. A disk that does not answer blocks its
/// thread for ever, so ends_within() limits the wait for the work's end. The owner must tell the
/// work to end before destroying this object, whose destructor waits for it.
class BackgroundThread {
 public:
  /// Called on this thread, with the reason, if the work ends by an exception; must not throw. The
  /// program goes on.
  using OnFailure = std::function<void(std::string_view why)>;

  BackgroundThread(std::function<void()> work, OnFailure on_failure) {
    std::promise<void> ended;
    ended_ = ended.get_future();
    thread_ = std::jthread([work = std::move(work), on_failure = std::move(on_failure),
                            ended = std::move(ended)]() mutable {
      try {
        work();
      } catch (const std::exception& error) {
        on_failure(error.what());
      }
      ended.set_value();
    });
  }

  /// True if the work ends within `patience`.
  [[nodiscard]] bool ends_within(std::chrono::milliseconds patience) {
    return ended_.wait_for(patience) == std::future_status::ready;
  }

 private:
  std::future<void> ended_;
  std::jthread thread_;
};

}  // namespace terracut::threads
