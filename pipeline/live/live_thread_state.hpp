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

/// Makes a request. `priority`: SCHED_FIFO, 0: shared scheduling. `core`: the only one it may run
/// on.
[[nodiscard]] threads::ThreadRequest thread_request(std::string name, int priority,
                                                    std::optional<int> core);

/// The state of a thread of a live run, for others to read once set_up() has returned.
struct LiveThreadState {
  std::string scheduling;  ///< As granted: "SCHED_FIFO priority 80, cores 0-3".
  std::atomic<std::int64_t> minor_faults{0}, major_faults{0};  ///< Since its work began.

  /// Sets up the calling thread; returns what the system granted and refused.
  [[nodiscard]] std::vector<threads::Grant> set_up(const threads::ThreadRequest& request);
  /// Notes the calling thread's faults since `at_start`.
  void note_faults(const measure::PageFaults& at_start) noexcept TERRACUT_NONBLOCKING;
};

}  // namespace terracut::live
