// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

namespace terracut::cli {

/// Writes texts to descriptors on a thread of its own, so that nobody who has something to say
/// waits for a pipe that is not read or a disk that does not answer. A text that finds kMostWaiting
/// before it is lost and counted; as soon as texts are taken again, it is written how many are
/// missing. Any thread without a deadline.
class MessageThread {
 public:
  static constexpr std::size_t kMostWaiting = 256;

  /// `on_error` is told the errno of a descriptor that cannot be written to, on the thread.
  using OnError = void (*)(int descriptor, int error_number);
  explicit MessageThread(OnError on_error);
  MessageThread(const MessageThread&) = delete;
  MessageThread& operator=(const MessageThread&) = delete;
  /// After finish() was true, or it waits for whoever does not read.
  ~MessageThread();

  void put(int descriptor, std::string text);
  /// False where what waits is not taken within that time.
  [[nodiscard]] bool finish(std::chrono::milliseconds patience);
  [[nodiscard]] std::uint64_t lost() const noexcept { return lost_; }

 private:
  struct Text {
    int descriptor;
    std::string bytes;
  };
  void work();
  void write(const Text& text) const;

  OnError on_error_;
  std::mutex mutex_;  ///< Between threads without a deadline.
  std::condition_variable came_, went_;
  std::deque<Text> waiting_;
  std::uint64_t lost_since_ = 0;  ///< Since the newest that waits.
  bool is_writing_ = false, over_ = false;
  std::atomic<std::uint64_t> lost_{0};
  std::jthread thread_;  ///< Last: it uses all of the above.
};

}  // namespace terracut::cli
