// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>

#include "rt/nonblocking.hpp"
#include "rt/proc_file.hpp"

namespace terracut::rt {

/// Where a thread's time went, up to some moment, or between two (since()). Nanoseconds.
///
///     wall = cpu (it worked) + waited (ready, but others had the core) + the rest: it slept, or
///            the host had taken the core away (only machines inside machines know that)
struct SchedulerReading {
  std::int64_t wall_ns = 0;
  std::int64_t cpu_ns = 0;
  std::int64_t waited_ns = 0;             ///< 0 where SchedulerTimes::knows_waiting() is false.
  std::int64_t voluntary_switches = 0;    ///< How often it went to sleep by itself.
  std::int64_t involuntary_switches = 0;  ///< How often another thread took its core.

  [[nodiscard]] SchedulerReading since(const SchedulerReading& earlier) const noexcept
      TERRACUT_NONBLOCKING;
};

/// Reads the times of one thread. To be made and read by that thread. Movable.
class SchedulerTimes {
 public:
  /// Opens what read() needs. Where the system does not tell the waiting, the rest is still told.
  [[nodiscard]] static SchedulerTimes of_this_thread();

  [[nodiscard]] bool knows_waiting() const noexcept TERRACUT_NONBLOCKING {
    return waiting_.has_value();
  }

  /// Four short system calls (some microseconds), no allocation, real-time safe.
  [[nodiscard]] SchedulerReading read() const noexcept TERRACUT_NONBLOCKING;

 private:
  std::optional<ProcFile> waiting_;
};

}  // namespace terracut::rt
