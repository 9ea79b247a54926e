// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>

#include "rt/measure/proc_file.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::measure {

/// Measures how long a thread has been ready to run while others had the core, summed since the
/// thread began. Wall time that is neither this nor processor time was spent asleep, or taken by
/// the host (see StolenTime). Only that thread may make and read this object. Movable.
class RunQueueWait {
 public:
  /// Opens the file that read_ns() needs.
  [[nodiscard]] static RunQueueWait of_this_thread();

  /// True if this kernel counts the waits.
  [[nodiscard]] bool is_known() const noexcept TERRACUT_NONBLOCKING { return file_.has_value(); }

  /// Returns the wait in nanoseconds; 0 if unknown. Makes one system call of less than a
  /// microsecond: cheap enough for every fetch of packets. Allocates nothing; real-time safe.
  [[nodiscard]] std::int64_t read_ns() const noexcept TERRACUT_NONBLOCKING;

 private:
  std::optional<ProcFile> file_;
};

}  // namespace terracut::measure
