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

/// What becomes of a frame that an output has no room for.
enum class WhenFull : std::uint8_t {
  kWait,        ///< Whoever brings it waits: of recordings nothing is to be lost.
  kDropOldest,  ///< The one that waits longest is left out, and counted: nothing waits.
};

/// An output with its queue and its thread.
class SinkWorker {
 public:
  /// Told once that, and why, an output gets nothing more; on its thread.
  using OnFailure = std::function<void(std::string_view sink, const Error& error)>;

  SinkWorker(std::unique_ptr<FrameSink> sink, WhenFull when_full, OnFailure on_failure);
  SinkWorker(const SinkWorker&) = delete;
  SinkWorker& operator=(const SinkWorker&) = delete;
  ~SinkWorker() { begin_to_finish(); }

  // From one thread.

  void put(SharedFrame frame);
  /// In place of those that the sink has not had yet.
  void put_figures(std::shared_ptr<const status::MonitorSnapshot> figures);
  /// What waits is written, then it ends.
  void begin_to_finish();
  /// False when it did not end; then the process must end without destroying this.
  [[nodiscard]] bool ends_within(std::chrono::milliseconds patience) {
    return thread_.ends_within(patience);
  }

  // From any thread.

  [[nodiscard]] const FrameSink& sink() const noexcept { return *sink_; }
  /// Frames that were left out for want of room, or came after a failure.
  [[nodiscard]] std::uint64_t left_out() const;
  /// Frames that wait or are in work: lost, too, if the sink hangs for good.
  [[nodiscard]] std::uint64_t waiting() const;
  /// The first error; after it the sink got nothing more.
  [[nodiscard]] std::optional<Error> failure() const;

 private:
  void work();
  /// The next piece of work; none: it is over.
  struct Work {
    SharedFrame frame;
    std::shared_ptr<const status::MonitorSnapshot> figures;
  };
  [[nodiscard]] std::optional<Work> next();
  void fail(const Error& error);

  std::unique_ptr<FrameSink> sink_;
  WhenFull when_full_;
  OnFailure on_failure_;

  mutable std::mutex mutex_;  ///< Between threads without a deadline.
  std::condition_variable came_, went_;
  std::deque<SharedFrame> frames_;
  std::shared_ptr<const status::MonitorSnapshot> figures_;
  std::uint64_t left_out_ = 0;
  bool is_working_ = false, finish_ = false;
  std::optional<Error> failure_;

  threads::BackgroundThread thread_;  ///< Last: it uses all of the above.
};

}  // namespace terracut::publish
