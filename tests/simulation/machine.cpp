// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tests/simulation/machine.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace terracut::simulation {
namespace {

constexpr std::int64_t kStart_ns = 1'767'225'600'000'000'000;  // 2026-01-01 UTC
constexpr std::int64_t kLeastWork_ns = 3'000, kMostWork_ns = 30'000;
constexpr std::int64_t kSlowest = 1'000'000;  ///< Times, where slow work meets slow work.

}  // namespace

void Machine::add_thread(std::int64_t least_ns, std::int64_t most_ns, FaultKind stalls,
                         std::function<void()> work) {
  const std::int64_t first_ns = dice_.between(0, most_ns);
  threads_.push_back({least_ns, most_ns, stalls, std::move(work), first_ns});
}

std::int64_t Machine::time_of_day_ns(std::int64_t at_ns) const noexcept {
  std::int64_t time_ns = kStart_ns + at_ns;
  for (const Fault& fault : faults_) {
    if (fault.kind == FaultKind::kHostClock && fault.at_ns() <= at_ns) {
      time_ns += fault.amount * 1'000'000;
    }
  }
  return time_ns;
}

std::int64_t Machine::end_of_stall(FaultKind stalls, std::int64_t at_ns) const noexcept {
  for (bool again = true; again;) {
    again = false;
    for (const Fault& fault : faults_) {
      if (!fault.is_on(stalls, at_ns)) continue;
      at_ns = fault.end_ns();
      again = true;
    }
  }
  return at_ns;
}

std::int64_t Machine::core_from(std::int64_t at_ns) const noexcept {
  return end_of_stall(FaultKind::kStolenCore, at_ns);
}

void Machine::work() {
  const std::int64_t work_ns = time_of_work(dice_.between(kLeastWork_ns, kMostWork_ns));
  cpu_ns_ += work_ns;
  wait_until(now_ns_ + work_ns);
}

/// Returns how long work takes that begins now: slower for as long as a fault slows it.
std::int64_t Machine::time_of_work(std::int64_t work_ns) const noexcept {
  std::int64_t at_ns = now_ns_;
  for (;;) {
    std::int64_t times = 1, until_ns = std::numeric_limits<std::int64_t>::max();
    for (const Fault& fault : faults_) {
      if (!fault.is_on(FaultKind::kSlowWork, at_ns)) continue;
      times = std::min(times * fault.amount, kSlowest);
      until_ns = std::min(until_ns, fault.end_ns());
    }
    if (work_ns * times <= until_ns - at_ns) return at_ns + work_ns * times - now_ns_;
    work_ns -= (until_ns - at_ns) / times;
    at_ns = until_ns;
  }
}

void Machine::wait_until(std::int64_t at_ns) {
  const std::int64_t there_ns = core_from(at_ns);
  waited_ns_ += there_ns - at_ns;
  pass_to(there_ns);
}

void Machine::pass_to(std::int64_t at_ns) {
  const OffTheRecord own_memory;
  for (;;) {
    const auto first = std::ranges::min_element(threads_, {}, &Thread::next_ns);
    if (first == threads_.end() || first->next_ns > at_ns) break;
    const std::int64_t awake_ns = end_of_stall(first->stalls, first->next_ns);
    if (awake_ns > first->next_ns) {
      first->next_ns = awake_ns;
      continue;
    }
    now_ns_ = std::max(now_ns_, first->next_ns);
    first->work();
    first->next_ns += dice_.between(first->least_ns, first->most_ns);
  }
  now_ns_ = std::max(now_ns_, at_ns);
}

}  // namespace terracut::simulation
