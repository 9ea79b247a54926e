// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/page_faults.hpp"

#include <sys/resource.h>

namespace terracut::rt {

TERRACUT_TRUSTED_CALLS_BEGIN  // getrusage of the own thread only copies counters
    PageFaults
    PageFaults::of_this_thread() noexcept TERRACUT_NONBLOCKING {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);  // cannot fail with these arguments
  return {usage.ru_minflt, usage.ru_majflt};
}
TERRACUT_TRUSTED_CALLS_END

}  // namespace terracut::rt
