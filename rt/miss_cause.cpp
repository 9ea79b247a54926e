// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/miss_cause.hpp"

#include <algorithm>

namespace terracut::rt {

MissCause name_miss_cause(const SchedulerReading& work, std::int64_t stolen_ns,
                          std::int64_t budget_ns) noexcept TERRACUT_NONBLOCKING {
  if (work.wall_ns <= budget_ns) return MissCause::kNone;
  // A kernel that is told of stolen time leaves it out of the processor time of threads.
  if (work.cpu_ns > budget_ns) return MissCause::kOwnWork;
  const std::int64_t rest_ns =
      std::max<std::int64_t>(work.wall_ns - work.cpu_ns - work.waited_ns, 0);
  if (work.waited_ns > rest_ns) return MissCause::kWaitedForACore;
  // Neither worked nor waited. Who never went to sleep had the core taken from under it; who did
  // may still have been robbed for the greater part.
  if (work.voluntary_switches > 0 && stolen_ns < rest_ns / 2) return MissCause::kSlept;
  // Where waiting is not told it is part of the rest; then another thread's turn is the sign of it.
  const bool waiting_is_told = work.waited_ns > 0;
  if (!waiting_is_told && work.involuntary_switches > 0 && stolen_ns < rest_ns / 2) {
    return MissCause::kWaitedForACore;
  }
  return MissCause::kStolenTime;
}

std::string_view to_string(MissCause cause) noexcept TERRACUT_NONBLOCKING {
  switch (cause) {
    case MissCause::kNone:
      return "in time";
    case MissCause::kOwnWork:
      return "own work";
    case MissCause::kWaitedForACore:
      return "waited for a core";
    case MissCause::kSlept:
      return "slept";
    case MissCause::kStolenTime:
      return "stolen time";
  }
  return "unknown";
}

}  // namespace terracut::rt
