// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/page_faults.hpp"

#include <sys/resource.h>

namespace terracut::rt {

PageFaults PageFaults::of_this_thread() noexcept TERRACUT_NONBLOCKING {
  rusage usage{};
  // Of the own thread it only copies counters, and cannot fail.
  trusted_call([&]() noexcept { ::getrusage(RUSAGE_THREAD, &usage); });
  return {usage.ru_minflt, usage.ru_majflt};
}

}  // namespace terracut::rt
