// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "rt/error.hpp"
#include "rt/threads/grant.hpp"

namespace terracut::threads {

/// The scheduler everybody shares (SCHED_OTHER).
struct SharedScheduling {};

/// SCHED_FIFO: runs before all of lower priority until it waits.
struct FifoScheduling {
  int priority = 50;  ///< [1, 99]; interrupt threads of a PREEMPT_RT kernel run at 50.
};

/// SCHED_DEADLINE: the kernel promises `runtime_ns` of processor time within `deadline_ns` of each
/// start of a period, or refuses at once; a thread that wants more in a period is stopped until
/// the next. 1'024 <= runtime_ns <= deadline_ns <= period_ns.
struct DeadlineScheduling {
  std::int64_t runtime_ns = 0;
  std::int64_t deadline_ns = 0;
  std::int64_t period_ns = 0;
};

using Scheduling = std::variant<SharedScheduling, FifoScheduling, DeadlineScheduling>;

/// What a thread asks for before its work begins.
struct ThreadRequest {
  std::string name;  ///< As top and debuggers show it; 1 to 15 bytes.
  Scheduling scheduling{};
  /// The only core it may run on, from 0; none: any. Not together with DeadlineScheduling, which
  /// the kernel refuses to a thread that may not run everywhere.
  std::optional<int> core{};
};

/// Sets up the calling thread. What the system refuses is in the grants, one for each request
/// (name, core, scheduling) in this order, with what holds instead and what would mend it; the
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
