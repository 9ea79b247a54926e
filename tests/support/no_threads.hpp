// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <pthread.h>

#include <cstddef>

namespace terracut::test {

/// As long as it lives, the system refuses this process every new thread (EAGAIN): they would have
/// stacks that no address space holds.
class NoThreads {
 public:
  NoThreads() {
    ::pthread_getattr_default_np(&before_);
    ::pthread_attr_t endless;
    ::pthread_getattr_default_np(&endless);
    ::pthread_attr_setstacksize(&endless, std::size_t{1} << 47);
    ::pthread_setattr_default_np(&endless);
    ::pthread_attr_destroy(&endless);
  }
  NoThreads(const NoThreads&) = delete;
  NoThreads& operator=(const NoThreads&) = delete;
  ~NoThreads() {
    ::pthread_setattr_default_np(&before_);
    ::pthread_attr_destroy(&before_);
  }

 private:
  ::pthread_attr_t before_;
};

}  // namespace terracut::test
