// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "stop_signal.hpp"

#include <csignal>

#include "console.hpp"

namespace terracut::cli {
namespace {

volatile std::sig_atomic_t wanted = 0;
void (*also_called)() noexcept = nullptr;

}  // namespace

void catch_stop_signals(void (*also)() noexcept) {
  also_called = also;
  struct sigaction action{};
  action.sa_handler = [](int) {
    wanted = 1;
    if (also_called != nullptr) also_called();
  };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

bool stop_wanted() noexcept {
  return wanted != 0;
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
