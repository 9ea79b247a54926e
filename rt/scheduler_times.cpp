// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/scheduler_times.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <utility>

#include "rt/thread_cpu_clock.hpp"

namespace terracut::rt {

SchedulerReading SchedulerReading::since(const SchedulerReading& earlier) const noexcept
    TERRACUT_NONBLOCKING {
  return {wall_ns - earlier.wall_ns, cpu_ns - earlier.cpu_ns, waited_ns - earlier.waited_ns,
          voluntary_switches - earlier.voluntary_switches,
          involuntary_switches - earlier.involuntary_switches};
}

SchedulerTimes SchedulerTimes::of_this_thread() {
  SchedulerTimes times;
  // "thread-self" is resolved now: the file stays that of this thread.
  auto file = ProcFile::open("/proc/thread-self/schedstat");
  if (!file) return times;
  std::array<char, 96> text{};
  // A kernel without these counts shows the file with nothing but zeros; a thread that runs has
  // been given a core at least once (the third number).
  if (nth_number(file->read(text), 2) > 0) times.waiting_ = std::move(*file);
  return times;
}

SchedulerReading SchedulerTimes::read() const noexcept TERRACUT_NONBLOCKING {
  SchedulerReading reading;
  rusage usage{};
  // Of the own thread it only copies counters.
  trusted_call([&]() noexcept { ::getrusage(RUSAGE_THREAD, &usage); });
  reading.voluntary_switches = usage.ru_nvcsw;
  reading.involuntary_switches = usage.ru_nivcsw;
  if (waiting_) {
    std::array<char, 96> text;  // three numbers of at most 20 digits: "ran waited turns"
    reading.waited_ns = std::max<std::int64_t>(nth_number(waiting_->read(text), 1), 0);
  }
  reading.cpu_ns = thread_cpu_ns();
  reading.wall_ns = monotonic_ns();
  return reading;
}

}  // namespace terracut::rt
