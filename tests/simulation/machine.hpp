// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tests/simulation/dice.hpp"
#include "tests/simulation/fault.hpp"
#include "tests/support/allocation_counter.hpp"

namespace terracut::simulation {

/// While one exists, allocations are the simulation's own, not those of the live run.
class OffTheRecord {
 public:
  OffTheRecord() noexcept : before_(depth()++ == 0 ? test::allocations_of_this_thread() : 0) {}
  ~OffTheRecord() {
    if (--depth() == 0) own() += test::allocations_of_this_thread() - before_;
  }
  OffTheRecord(const OffTheRecord&) = delete;
  OffTheRecord& operator=(const OffTheRecord&) = delete;

  /// Returns the allocations of the live run on this thread.
  [[nodiscard]] static std::uint64_t of_the_run() noexcept {
    return test::allocations_of_this_thread() - own();
  }

 private:
  static int& depth() noexcept {
    thread_local int depth = 0;
    return depth;
  }
  static std::uint64_t& own() noexcept {
    thread_local std::uint64_t own = 0;
    return own;
  }
  std::uint64_t before_;
};

/// A computer in simulated time: one thread with a deadline, whose work takes time and which a
/// fault may keep from running, and other threads, each of which runs now and then. The other
/// threads run, one at a time, whenever the first one looks at a clock or waits: in the middle of
/// its work, as on another core. All times are nanoseconds since the run began, but for
/// time_of_day_ns().
class Machine {
 public:
  Machine(const Faults& faults, std::uint64_t seed) : faults_(faults), dice_(seed) {}

  /// Adds a thread that runs every `least_ns` to `most_ns`, except during faults of a kind.
  void add_thread(std::int64_t least_ns, std::int64_t most_ns, FaultKind stalls,
                  std::function<void()> work);

  [[nodiscard]] std::int64_t now_ns() const noexcept { return now_ns_; }
  [[nodiscard]] std::int64_t cpu_ns() const noexcept { return cpu_ns_; }
  [[nodiscard]] std::int64_t waited_ns() const noexcept { return waited_ns_; }
  [[nodiscard]] std::int64_t time_of_day_ns(std::int64_t at_ns) const noexcept;
  [[nodiscard]] std::int64_t time_of_day_ns() const noexcept { return time_of_day_ns(now_ns_); }

  /// The first thread has done a piece of work.
  void work();
  /// The first thread waits until `at_ns`, and for its core if that is away by then.
  void wait_until(std::int64_t at_ns);

 private:
  struct Thread {
    std::int64_t least_ns, most_ns;
    FaultKind stalls;
    std::function<void()> work;
    std::int64_t next_ns;
  };
  /// Lets time pass, in which the other threads run.
  void pass_to(std::int64_t at_ns);
  [[nodiscard]] std::int64_t time_of_work(std::int64_t work_ns) const noexcept;
  /// Returns when the core is there that is wanted at `at_ns`.
  [[nodiscard]] std::int64_t core_from(std::int64_t at_ns) const noexcept;
  [[nodiscard]] std::int64_t end_of_stall(FaultKind stalls, std::int64_t at_ns) const noexcept;

  const Faults& faults_;
  Dice dice_;
  std::vector<Thread> threads_;
  std::int64_t now_ns_ = 0, cpu_ns_ = 0, waited_ns_ = 0;
};

/// The clocks of a machine, like measure::SystemClock. A look at the time of day ends a piece of
/// work.
struct MachineClock {
  Machine* machine;
  [[nodiscard]] std::int64_t realtime_ns() const noexcept {
    machine->work();
    return machine->time_of_day_ns();
  }
  [[nodiscard]] std::int64_t monotonic_ns() const noexcept { return machine->now_ns(); }
  [[nodiscard]] std::int64_t thread_cpu_ns() const noexcept { return machine->cpu_ns(); }
};

/// How long the first thread waited for its core, like measure::RunQueueWait.
struct MachineWait {
  Machine* machine;
  [[nodiscard]] std::int64_t read_ns() const noexcept { return machine->waited_ns(); }
};

}  // namespace terracut::simulation
