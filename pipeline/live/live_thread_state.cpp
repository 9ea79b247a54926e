// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "live_thread_state.hpp"

#include <fmt/format.h>

#include <utility>

namespace terracut::live {

threads::ThreadRequest thread_request(std::string name, int priority, std::optional<int> core) {
  return {.name = std::move(name), .priority = priority, .core = core};
}

std::vector<threads::Grant> LiveThreadState::set_up(const threads::ThreadRequest& request) {
  auto granted = threads::set_up_this_thread(request);
  scheduling =
      fmt::format("{}, core {}", threads::scheduling_in_force(), threads::cores_in_force());
  return granted ? *std::move(granted) : std::vector<threads::Grant>{};
}

void LiveThreadState::note_faults(const measure::PageFaults& at_start) noexcept {
  const measure::PageFaults now = measure::PageFaults::of_this_thread().since(at_start);
  minor_faults.store(now.minor, std::memory_order_relaxed);
  major_faults.store(now.major, std::memory_order_relaxed);
}

}  // namespace terracut::live
