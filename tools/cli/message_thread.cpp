// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "message_thread.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <utility>

namespace terracut::cli {

MessageThread::MessageThread(OnError on_error) : on_error_(on_error), thread_([this] { work(); }) {}

MessageThread::~MessageThread() {
  const std::scoped_lock lock(mutex_);
  over_ = true;
  came_.notify_one();
}

void MessageThread::put(int descriptor, std::string text) {
  {
    const std::scoped_lock lock(mutex_);
    if (waiting_.size() >= kMostWaiting) {
      ++lost_since_;
      ++lost_;
      return;
    }
    if (lost_since_ > 0) {
      text = fmt::format("warning: {} messages before this one are lost: nobody took them\n{}",
                         std::exchange(lost_since_, 0), text);
    }
    waiting_.push_back({descriptor, std::move(text)});
  }
  came_.notify_one();
}

bool MessageThread::finish(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  return went_.wait_for(lock, patience, [this] { return waiting_.empty() && !is_writing_; });
}

void MessageThread::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    came_.wait(lock, [this] { return over_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const Text text = std::move(waiting_.front());
    waiting_.pop_front();
    is_writing_ = true;
    lock.unlock();
    write(text);
    lock.lock();
    is_writing_ = false;
    went_.notify_all();
  }
}

void MessageThread::write(const Text& text) const {
  for (std::string_view rest = text.bytes; !rest.empty();) {
    const ::ssize_t written = ::write(text.descriptor, rest.data(), rest.size());
    if (written >= 0) {
      rest.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno == EAGAIN) {  // another process has made the shared descriptor non-blocking
      ::pollfd room{text.descriptor, POLLOUT, 0};
      (void)::poll(&room, 1, -1);
    } else if (errno != EINTR) {
      return on_error_(text.descriptor, errno);
    }
  }
}

}  // namespace terracut::cli
