// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rt/error.hpp"
#include "rt/threads/grant.hpp"

namespace terracut::threads {

/// What a thread asks of the system before its work begins.
struct ThreadRequest {
  std::string name;  ///< The thread's name in top and debuggers, 1 to 15 bytes.
  /// The SCHED_FIFO priority, [1, 99]: the thread runs before all of lower priority until it waits;
  /// interrupt threads of a PREEMPT_RT kernel run at 50. 0: shared scheduling (SCHED_OTHER).
  int priority = 0;
  /// The only core the thread may run on, counted from 0; empty: any core.
  std::optional<int> core{};
};

/// Sets up the calling thread. Returns a grant for each request (name, core, priority, in this
/// order): what was refused, what holds instead and how to mend it; the thread can go on. Threads
/// that this one creates get shared scheduling. Fails with kInvalidArgument, and changes nothing,
/// if a request is outside its documented range. Start-up only.
[[nodiscard]] Expected<std::vector<Grant>> set_up_this_thread(const ThreadRequest& request);

/// Returns how the calling thread is scheduled: "SCHED_FIFO priority 50".
[[nodiscard]] std::string scheduling_in_force();

/// Returns the cores the calling thread may run on, ascending; empty if the system does not tell.
[[nodiscard]] std::vector<int> allowed_cores();

/// Returns the cores the calling thread may run on as text: "0-3,6".
[[nodiscard]] std::string cores_in_force();

}  // namespace terracut::threads
