// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "live_thread_state.hpp"

#include <fmt/format.h>

#include <utility>

namespace terracut::cli {

rt::ThreadWish thread_wish(std::string name, int priority, std::optional<int> core) {
  rt::ThreadWish wish{.name = std::move(name), .scheduling = {}, .core = core};
  if (priority > 0) wish.scheduling = rt::FifoScheduling{priority};
  return wish;
}

std::vector<rt::Grant> LiveThreadState::set_up(const rt::ThreadWish& wish) {
  auto granted = rt::set_up_this_thread(wish);
  scheduling = fmt::format("{}, core {}", rt::scheduling_in_force(), rt::cores_in_force());
  return granted ? *std::move(granted) : std::vector<rt::Grant>{};
}

void LiveThreadState::note_faults(const rt::PageFaults& at_start) noexcept {
  const rt::PageFaults now = rt::PageFaults::of_this_thread().since(at_start);
  minor_faults.store(now.minor, std::memory_order_relaxed);
  major_faults.store(now.major, std::memory_order_relaxed);
}

}  // namespace terracut::cli
