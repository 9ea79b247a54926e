// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <optional>
#include <utility>

#include "rt/error.hpp"
#include "rt/measure/thread_cpu_clock.hpp"

namespace terracut::publish {

/// Something that may not be to be had now, a port that another program has or a disk without room:
/// it is opened when it is asked for, and where that fails, again now and then. One thread, without
/// a deadline.
template <class T>
class Reopened {
 public:
  using Open = std::function<Expected<T>()>;
  /// Told once why it is not to be had any more, and once when it is there again.
  using OnNews = std::function<void(const Status&)>;
  struct Config {
    Open open;
    OnNews on_news;
    std::chrono::nanoseconds again_after = std::chrono::seconds(10);
  };

  explicit Reopened(Config config) : config_(std::move(config)) {}

  /// Null where it is not to be had. What open() throws is an error like any other.
  [[nodiscard]] T* get() {
    if (thing_ || measure::monotonic_ns() < due_ns_) return thing_ ? &*thing_ : nullptr;
    auto opened = caught();
    if (!opened) {
      fail(opened.error());
      return nullptr;
    }
    thing_.emplace(*std::move(opened));
    if (std::exchange(has_failed_, false)) config_.on_news({});
    return &*thing_;
  }

  /// It does not work any more: away with it.
  void give_up(const Error& error) {
    thing_.reset();
    fail(error);
  }

  /// Null where it is not open.
  [[nodiscard]] T* opened() noexcept { return thing_ ? &*thing_ : nullptr; }

 private:
  [[nodiscard]] Expected<T> caught() const {
    try {
      return config_.open();
    } catch (const std::exception& error) {
      return terracut::fail(ErrorCode::kCapacityExceeded, error.what());
    }
  }
  void fail(const Error& error) {
    due_ns_ = measure::monotonic_ns() + config_.again_after.count();
    if (!std::exchange(has_failed_, true)) config_.on_news(tl::unexpected(error));
  }

  Config config_;
  std::optional<T> thing_;
  std::int64_t due_ns_ = 0;
  bool has_failed_ = false;
};

}  // namespace terracut::publish
