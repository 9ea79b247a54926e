// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <ctime>

#include <cstdint>

#include "rt/threads/nonblocking.hpp"

namespace terracut::measure {

/// Clocks. thread_cpu_ns() and monotonic_ns() never step. All are real-time safe and thread-safe;
/// their system calls do not block.

/// Returns the processor time that the calling thread has used, in nanoseconds
/// (CLOCK_THREAD_CPUTIME_ID): the cost of a computation, whatever else the machine does. Only
/// differences between two calls on one thread have a meaning.
[[nodiscard]] inline std::int64_t thread_cpu_ns() noexcept TERRACUT_NONBLOCKING;

/// Returns nanoseconds since an arbitrary start (CLOCK_MONOTONIC), for measuring deadlines.
[[nodiscard]] inline std::int64_t monotonic_ns() noexcept TERRACUT_NONBLOCKING;

/// Returns nanoseconds since 1970 (CLOCK_REALTIME), comparable with the kernel's packet stamps. The
/// clock steps when somebody sets it.
[[nodiscard]] inline std::int64_t realtime_ns() noexcept TERRACUT_NONBLOCKING;

namespace detail {
[[nodiscard]] inline std::int64_t read_clock_ns(clockid_t clock) noexcept TERRACUT_NONBLOCKING {
  timespec now{};
  // clock_gettime() reads a page shared with the kernel, or asks the kernel; for these clocks it
  // cannot fail on Linux.
  threads::trusted_call([&]() noexcept { ::clock_gettime(clock, &now); });
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}
}  // namespace detail

inline std::int64_t thread_cpu_ns() noexcept TERRACUT_NONBLOCKING {
  return detail::read_clock_ns(CLOCK_THREAD_CPUTIME_ID);
}
inline std::int64_t monotonic_ns() noexcept TERRACUT_NONBLOCKING {
  return detail::read_clock_ns(CLOCK_MONOTONIC);
}
inline std::int64_t realtime_ns() noexcept TERRACUT_NONBLOCKING {
  return detail::read_clock_ns(CLOCK_REALTIME);
}

/// Bundles the clocks as a type parameter, so that tests can replace them.
struct SystemClock {
  [[nodiscard]] std::int64_t realtime_ns() const noexcept TERRACUT_NONBLOCKING {
    return measure::realtime_ns();
  }
  [[nodiscard]] std::int64_t monotonic_ns() const noexcept TERRACUT_NONBLOCKING {
    return measure::monotonic_ns();
  }
  [[nodiscard]] std::int64_t thread_cpu_ns() const noexcept TERRACUT_NONBLOCKING {
    return measure::thread_cpu_ns();
  }
};

/// The readings of two clocks, taken together.
struct ClockPair {
  std::int64_t cpu_ns = 0;
  std::int64_t wall_ns = 0;

  [[nodiscard]] static ClockPair now() noexcept TERRACUT_NONBLOCKING {
    return {thread_cpu_ns(), monotonic_ns()};
  }
  [[nodiscard]] ClockPair since(const ClockPair& earlier) const noexcept TERRACUT_NONBLOCKING {
    return {cpu_ns - earlier.cpu_ns, wall_ns - earlier.wall_ns};
  }
};

}  // namespace terracut::measure
