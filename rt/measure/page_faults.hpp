// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

#include "rt/threads/nonblocking.hpp"

namespace terracut::measure {

/// How often the calling thread met memory that was not there. After a start that went well both
/// differences stay 0, frame after frame.
struct PageFaults {
  std::int64_t minor = 0;  ///< The page came from memory: a microsecond or so.
  std::int64_t major = 0;  ///< The page came from a disk: milliseconds.

  /// Since the thread began. One short system call, real-time safe.
  [[nodiscard]] static PageFaults of_this_thread() noexcept TERRACUT_NONBLOCKING;

  [[nodiscard]] PageFaults since(const PageFaults& earlier) const noexcept TERRACUT_NONBLOCKING {
    return {minor - earlier.minor, major - earlier.major};
  }
  [[nodiscard]] bool operator==(const PageFaults&) const = default;
};

}  // namespace terracut::measure
