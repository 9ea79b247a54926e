// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rt/error.hpp"
#include "rt/threads/grant.hpp"

namespace terracut::memory {

/// What to ask for a region besides present pages; the system may refuse each of the two requests.
struct RegionRequest {
  /// True: locks the region in memory, however much others need.
  bool lock = false;
  /// True: builds the region from pages of 2 MiB, which need fewer entries in the processor's
  /// address cache. The kernel uses small pages where memory is fragmented.
  bool large_pages = true;
};

/// Owns one contiguous piece of zeroed memory from the system; every page is present from the
/// start, so that no first touch faults. The destructor returns the memory. Not real-time safe;
/// movable, not thread-safe.
class MemoryRegion {
 public:
  /// Makes an empty region.
  MemoryRegion() = default;
  MemoryRegion(MemoryRegion&& other) noexcept;
  MemoryRegion& operator=(MemoryRegion&& other) noexcept;
  ~MemoryRegion();

  /// Maps a region of `bytes`, at least page-aligned; 0 gives an empty one. Fails with
  /// kCapacityExceeded and the system's reason if there is not enough memory.
  [[nodiscard]] static Expected<MemoryRegion> map(std::size_t bytes, const RegionRequest& request);

  [[nodiscard]] std::span<std::byte> bytes() const noexcept { return bytes_; }
  /// Returns the system's answer to each request.
  [[nodiscard]] const std::vector<threads::Grant>& grants() const noexcept { return grants_; }

 private:
  std::span<std::byte> bytes_;    // the bytes asked for
  std::span<std::byte> mapping_;  // the whole pages around them
  std::vector<threads::Grant> grants_;
};

}  // namespace terracut::memory
