// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pinned_thread.hpp"

#include "rt/threads/thread_setup.hpp"

namespace terracut::eval {

void pin_this_thread(const std::string& name, const std::vector<int>& cores, std::size_t index) {
  threads::ThreadRequest request{.name = name};
  if (!cores.empty()) request.core = cores[index % cores.size()];
  (void)threads::set_up_this_thread(request);
}

}  // namespace terracut::eval
