// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "rt/threads/nonblocking.hpp"

namespace terracut::measure {

/// Counts the page faults of the calling thread. After a good start-up neither counter grows any
/// more.
struct PageFaults {
  std::int64_t minor = 0;  ///< Pages mapped from memory: each costs about a microsecond.
  std::int64_t major = 0;  ///< Pages read from a disk: each costs milliseconds.

  /// Returns the faults since the thread began. Makes one short system call; real-time safe.
  [[nodiscard]] static PageFaults of_this_thread() noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] PageFaults since(const PageFaults& earlier) const noexcept TERRACUT_NONBLOCKING {
    return {minor - earlier.minor, major - earlier.major};
  }
  [[nodiscard]] bool operator==(const PageFaults&) const = default;
};

}  // namespace terracut::measure
