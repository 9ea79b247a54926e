// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "stop_signal.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>

#include "console.hpp"

namespace terracut::cli {
namespace {

/// Set by the thread on which the signal arrives, read by all threads that work.
std::atomic<bool> wanted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not lock");
void (*also_called)() noexcept = nullptr;

}  // namespace

void catch_stop_signals(void (*also)() noexcept) {
  also_called = also;
  struct sigaction action{};
  action.sa_handler = [](int) {
    const int before = errno;
    wanted = true;
    if (also_called != nullptr) also_called();
    errno = before;
  };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

bool stop_wanted() noexcept {
  return wanted;
}

Status go_on() {
  if (!stop_wanted()) return {};
  return fail(ErrorCode::kNothingCameOut, "interrupted");
}

ExitCode refuse_work(const Error& error) {
  if (!stop_wanted()) return refuse(error);
  return refuse(kInterrupted, "interrupted: the work was not done, and nothing was written");
}

}  // namespace terracut::cli
