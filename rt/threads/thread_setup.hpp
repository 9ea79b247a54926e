// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rt/error.hpp"
#include "rt/threads/grant.hpp"

namespace terracut::threads {

/// What a thread asks for before its work begins.
struct ThreadRequest {
  std::string name;  ///< As top and debuggers show it; 1 to 15 bytes.
  /// Of SCHED_FIFO, which runs before all of lower priority until it waits, [1, 99]; interrupt
  /// threads of a PREEMPT_RT kernel run at 50. 0: the scheduler everybody shares (SCHED_OTHER).
  int priority = 0;
  std::optional<int> core{};  ///< The only one it may run on, from 0; none: any.
};

/// Sets up the calling thread. What the system refuses is in the grants, one for each request
/// (name, core, priority) in this order, with what holds instead and what would mend it; the
/// thread can go on. Threads that this one creates get shared scheduling. kInvalidArgument, and
/// nothing changed, for a request outside its documented range. Start-up only.
[[nodiscard]] Expected<std::vector<Grant>> set_up_this_thread(const ThreadRequest& request);

/// How the calling thread is scheduled: "SCHED_FIFO priority 50".
[[nodiscard]] std::string scheduling_in_force();

/// The cores the calling thread may run on, ascending; empty when the system does not tell.
[[nodiscard]] std::vector<int> allowed_cores();

/// The same as text: "0-3,6".
[[nodiscard]] std::string cores_in_force();

}  // namespace terracut::threads
