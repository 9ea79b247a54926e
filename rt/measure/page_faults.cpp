// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/measure/page_faults.hpp"

#include <sys/resource.h>

namespace terracut::measure {

PageFaults PageFaults::of_this_thread() noexcept TERRACUT_NONBLOCKING {
  rusage usage{};
  // For the calling thread getrusage() only copies counters and cannot fail.
  threads::trusted_call([&]() noexcept { ::getrusage(RUSAGE_THREAD, &usage); });
  return {usage.ru_minflt, usage.ru_majflt};
}

}  // namespace terracut::measure
