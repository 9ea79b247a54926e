// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "stop_signal.hpp"

#include <csignal>

namespace terracut::cli {
namespace {

volatile std::sig_atomic_t wanted = 0;

}  // namespace

void catch_stop_signals() {
  struct sigaction action{};
  action.sa_handler = [](int) { wanted = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

bool stop_wanted() noexcept {
  return wanted != 0;
}

}  // namespace terracut::cli
