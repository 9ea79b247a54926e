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

/// Holds an object that may be unavailable, such as a port in use by another program or a disk
/// without room. Opens the object on demand and, if that fails, again at intervals. For one thread
/// without a deadline.
template <class T>
class Reopened {
 public:
  using Open = std::function<Expected<T>()>;
  /// Called once with the reason when the object becomes unavailable, once when it is back.
  using OnNews = std::function<void(const Status&)>;
  struct Config {
    Open open;
    OnNews on_news;
    std::chrono::nanoseconds again_after = std::chrono::seconds(10);
  };

  explicit Reopened(Config config) : config_(std::move(config)) {}

  /// Returns the object, or null if it is unavailable. An exception from open() counts as an error.
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

  /// Drops the object because it no longer works.
  void give_up(const Error& error) {
    thing_.reset();
    fail(error);
  }

  /// Returns the object, or null if it is not open.
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
