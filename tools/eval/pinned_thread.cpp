// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pinned_thread.hpp"

#include "rt/thread_setup.hpp"

namespace terracut::evaluation {

void pin_this_thread(const std::string& name, const std::vector<int>& cores, std::size_t index) {
  rt::ThreadWish wish{.name = name, .scheduling = {}, .core = {}};
  if (!cores.empty()) wish.core = cores[index % cores.size()];
  (void)rt::set_up_this_thread(wish);
}

}  // namespace terracut::evaluation
