// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rt/error.hpp"
#include "rt/threads/grant.hpp"

namespace terracut::memory {

/// What is asked for a region beyond its presence; the system may refuse either.
struct RegionRequest {
  /// Keeps it in memory, however much others need.
  bool lock = false;
  /// Builds it from pages of 2 MiB, which need fewer entries in the processor's address cache.
  /// Where memory is fragmented the kernel uses small pages.
  bool large_pages = true;
};

/// One contiguous piece of zeroed memory, taken from the system; every page is present from the
/// start, so that no first touch faults. Returned when destroyed. Not real-time safe; movable, not
/// thread-safe.
class MemoryRegion {
 public:
  /// Makes a region of no memory.
  MemoryRegion() = default;
  MemoryRegion(MemoryRegion&& other) noexcept;
  MemoryRegion& operator=(MemoryRegion&& other) noexcept;
  ~MemoryRegion();

  /// Maps a region, at least page-aligned. `bytes` of 0 gives a region of no memory.
  /// kCapacityExceeded, with the system's reason, if there is not that much.
  [[nodiscard]] static Expected<MemoryRegion> map(std::size_t bytes, const RegionRequest& request);

  [[nodiscard]] std::span<std::byte> bytes() const noexcept { return bytes_; }
  /// Returns what the system granted of each request.
  [[nodiscard]] const std::vector<threads::Grant>& grants() const noexcept { return grants_; }

 private:
  std::span<std::byte> bytes_;    // the bytes asked for
  std::span<std::byte> mapping_;  // the whole pages around them
  std::vector<threads::Grant> grants_;
};

}  // namespace terracut::memory
