// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>

#include "rt/measure/proc_file.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::measure {

/// The time a thread was ready to run while others had the core, summed since it began. Wall time
/// that is neither this nor processor time was spent asleep, or taken by the host (see StolenTime).
/// To be made and read by that thread. Movable.
class RunQueueWait {
 public:
  /// Opens the file that read_ns() needs.
  [[nodiscard]] static RunQueueWait of_this_thread();

  /// True if this kernel counts the waits.
  [[nodiscard]] bool is_known() const noexcept TERRACUT_NONBLOCKING { return file_.has_value(); }

  /// Returns nanoseconds; 0 if unknown. One system call, less than a microsecond: cheap enough for
  /// every fetch of packets. No allocation, real-time safe.
  [[nodiscard]] std::int64_t read_ns() const noexcept TERRACUT_NONBLOCKING;

 private:
  std::optional<ProcFile> file_;
};

}  // namespace terracut::measure
