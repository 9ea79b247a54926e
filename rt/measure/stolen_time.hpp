// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "rt/error.hpp"
#include "rt/measure/proc_file.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::measure {

/// Measures the time that a virtual machine's host gave to others while this machine had work:
/// summed over all cores since boot, in steps of a hundredth of a second. Always 0 on bare metal.
/// For each reading the kernel writes all of /proc/stat, which takes up to a millisecond on large
/// machines: read once a second or after a missed deadline, not every frame. Movable; one thread at
/// a time.
class StolenTime {
 public:
  /// Opens /proc/stat. Fails with kNotFound or kUnreadable if that is impossible.
  [[nodiscard]] static Expected<StolenTime> open();

  /// Returns the stolen time in nanoseconds; nothing if the system no longer tells. Allocates
  /// nothing and waits for no disk.
  [[nodiscard]] std::optional<std::int64_t> read_ns() const noexcept TERRACUT_NONBLOCKING;

  /// Returns the stolen time from `text`, the content of /proc/stat. `ticks_per_s` is
  /// sysconf(_SC_CLK_TCK).
  [[nodiscard]] static std::optional<std::int64_t> parse_ns(
      std::string_view text, std::int64_t ticks_per_s) noexcept TERRACUT_NONBLOCKING;

 private:
  StolenTime(ProcFile file, std::int64_t ticks_per_s);
  ProcFile file_;
  std::int64_t ticks_per_s_;
};

}  // namespace terracut::measure
