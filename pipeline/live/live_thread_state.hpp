// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rt/measure/page_faults.hpp"
#include "rt/threads/grant.hpp"
#include "rt/threads/nonblocking.hpp"
#include "rt/threads/thread_setup.hpp"

namespace terracut::live {

/// Makes a thread's request. `priority` is for SCHED_FIFO; 0 requests shared scheduling. If `core`
/// is given, the thread may run on no other.
[[nodiscard]] threads::ThreadRequest thread_request(std::string name, int priority,
                                                    std::optional<int> core);

/// The state of a live run's thread; other threads may read it once set_up() has returned.
struct LiveThreadState {
  std::string scheduling;  ///< Scheduling granted: "SCHED_FIFO priority 80, cores 0-3".
  std::atomic<std::int64_t> minor_faults{0}, major_faults{0};  ///< Page faults since work began.

  /// Sets up the calling thread. Returns what the system granted and what it refused.
  [[nodiscard]] std::vector<threads::Grant> set_up(const threads::ThreadRequest& request);
  /// Counts the calling thread's page faults since `at_start`.
  void note_faults(const measure::PageFaults& at_start) noexcept TERRACUT_NONBLOCKING;
};

}  // namespace terracut::live
