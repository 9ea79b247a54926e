// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>

#include "rt/measure/proc_file.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::measure {

/// How long a thread was ready to run while others had the core, summed since it began. What is
/// left of wall time beside this and its processor time, it slept; or the host had taken the core
/// away, which only StolenTime knows. To be made and read by that thread. Movable.
class RunQueueWait {
 public:
  /// Opens what read_ns() needs.
  [[nodiscard]] static RunQueueWait of_this_thread();

  /// Whether this kernel tells.
  [[nodiscard]] bool is_known() const noexcept TERRACUT_NONBLOCKING { return file_.has_value(); }

  /// Nanoseconds; 0 where it is not known. One system call, less than a microsecond: cheap enough
  /// for every time packets are fetched. No allocation, real-time safe.
  [[nodiscard]] std::int64_t read_ns() const noexcept TERRACUT_NONBLOCKING;

 private:
  std::optional<ProcFile> file_;
};

}  // namespace terracut::measure
