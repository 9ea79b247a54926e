// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string_view>
#include <vector>

#include "pipeline/publish/frame_sink.hpp"
#include "rt/threads/background_thread.hpp"

namespace terracut::publish {

/// What happens to a frame when an output's queue is full.
enum class WhenFull : std::uint8_t {
  kWait,        ///< The producer waits: a recording must not lose frames.
  kDropOldest,  ///< The oldest waiting frame is left out and counted.
};

/// Runs an output with a queue and a thread of its own.
class SinkWorker {
 public:
  /// Called once, on the output's thread, with the reason why the output gets nothing more.
  using OnFailure = std::function<void(std::string_view sink, const Error& error)>;

  SinkWorker(std::unique_ptr<FrameSink> sink, WhenFull when_full, OnFailure on_failure);
  SinkWorker(const SinkWorker&) = delete;
  SinkWorker& operator=(const SinkWorker&) = delete;
  ~SinkWorker() { begin_to_finish(); }

  // For one thread:

  void put(SharedFrame frame);
  /// Hands over a sector of a frame that comes later. Never waits: the oldest waiting sector is
  /// left out and counted. Only for a sink that wants sectors.
  void put_sector(SharedSector sector);
  /// Hands over figures; figures that the sink has not taken yet are replaced.
  void put_figures(std::shared_ptr<const status::MonitorSnapshot> figures);
  /// Lets the thread write all that waits and then end.
  void begin_to_finish();
  /// False if the thread did not end; the process must then end without destroying this object.
  [[nodiscard]] bool ends_within(std::chrono::milliseconds patience) {
    return thread_.ends_within(patience);
  }

  // For any thread:

  [[nodiscard]] const FrameSink& sink() const noexcept { return *sink_; }
  /// Returns how many frames were left out for lack of room or after a failure.
  [[nodiscard]] std::uint64_t left_out() const;
  [[nodiscard]] std::uint64_t sectors_left_out() const;
  /// Returns how many frames wait or are being written; they are lost if the sink hangs for good.
  [[nodiscard]] std::uint64_t waiting() const;
  [[nodiscard]] std::uint64_t sectors_waiting() const;
  /// Returns the first error, if any; after it the sink got nothing more.
  [[nodiscard]] std::optional<Error> failure() const;

 private:
  static constexpr std::size_t kMostSectors = 256;  // more than a turn has

  void work();
  /// The next piece of work for the thread; empty at the end.
  struct Work {
    SharedSector sector;
    SharedFrame frame;
    std::shared_ptr<const status::MonitorSnapshot> figures;
  };
  [[nodiscard]] std::optional<Work> next();
  /// True if a sector waits that comes before the oldest waiting frame.
  [[nodiscard]] bool is_sector_next() const;
  void fail(const Error& error);

  std::unique_ptr<FrameSink> sink_;
  WhenFull when_full_;
  OnFailure on_failure_;

  mutable std::mutex mutex_;  ///< Shared by threads without a deadline.
  std::condition_variable came_, went_;
  std::deque<SharedFrame> frames_;
  std::deque<SharedSector> sectors_;
  std::shared_ptr<const status::MonitorSnapshot> figures_;
  std::uint64_t left_out_ = 0, sectors_left_out_ = 0;
  bool is_working_ = false, is_working_on_sector_ = false, finish_ = false;
  std::optional<Error> failure_;

  threads::BackgroundThread thread_;  ///< Declared last, because it uses the members above.
};

}  // namespace terracut::publish
