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

/// Writes texts to descriptors on a thread of its own, so that no caller waits for an unread pipe
/// or a slow disk. A text is lost and counted if kMostWaiting others wait; later, when texts are
/// taken again, the number of lost ones is written. For any thread without a deadline.
class MessageThread {
 public:
  static constexpr std::size_t kMostWaiting = 256;

  /// Called on the writing thread with the errno of a descriptor that cannot be written to.
  using OnError = void (*)(int descriptor, int error_number);
  explicit MessageThread(OnError on_error);
  MessageThread(const MessageThread&) = delete;
  MessageThread& operator=(const MessageThread&) = delete;
  /// Waits for a stalled reader unless finish() has returned true.
  ~MessageThread();

  void put(int descriptor, std::string text);
  /// Returns false if the waiting texts are not taken within `patience`.
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
  std::mutex mutex_;  ///< Shared by threads without a deadline.
  std::condition_variable came_, went_;
  std::deque<Text> waiting_;
  std::uint64_t lost_since_ = 0;  ///< Texts lost since the newest waiting text.
  bool is_writing_ = false, over_ = false;
  std::atomic<std::uint64_t> lost_{0};
  std::jthread thread_;  ///< Declared last: uses all members above.
};

}  // namespace terracut::cli
