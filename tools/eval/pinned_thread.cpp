// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pinned_thread.hpp"

#include <sched.h>

#include "rt/thread_setup.hpp"

namespace terracut::evaluation {

std::vector<int> allowed_cores() {
  ::cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores;
  if (::sched_getaffinity(0, sizeof(set), &set) != 0) return cores;
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(core, &set)) cores.push_back(core);
  }
  return cores;
}

void pin_this_thread(const std::string& name, const std::vector<int>& cores, std::size_t index) {
  rt::ThreadWish wish{.name = name, .scheduling = {}, .core = {}};
  if (!cores.empty()) wish.core = cores[index % cores.size()];
  (void)rt::set_up_this_thread(wish);
}

}  // namespace terracut::evaluation
