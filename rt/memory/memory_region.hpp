// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rt/error.hpp"
#include "rt/threads/grant.hpp"

namespace terracut::memory {

/// What a region should be beyond being there; the system may refuse either.
struct RegionRequest {
  /// Keep it in memory, whatever else the machine needs memory for.
  bool lock = false;
  /// Build it from pages of 2 MiB, which need fewer entries in the processor's address cache. A
  /// request: the kernel uses small pages where memory is fragmented.
  bool large_pages = true;
};

/// One contiguous piece of zeroed memory, straight from the system, every page of it present from
/// the start, so that no first touch costs a page fault later. Given back when it is destroyed.
/// Not real-time safe; movable, not thread-safe.
class MemoryRegion {
 public:
  /// No memory.
  MemoryRegion() = default;
  MemoryRegion(MemoryRegion&& other) noexcept;
  MemoryRegion& operator=(MemoryRegion&& other) noexcept;
  ~MemoryRegion();

  /// At least page-aligned. `bytes` of 0 is a region of no memory. kCapacityExceeded, with the
  /// system's reason, when there is not that much.
  [[nodiscard]] static Expected<MemoryRegion> map(std::size_t bytes, const RegionRequest& request);

  [[nodiscard]] std::span<std::byte> bytes() const noexcept { return bytes_; }
  /// What the system granted of each request.
  [[nodiscard]] const std::vector<threads::Grant>& grants() const noexcept { return grants_; }

 private:
  std::span<std::byte> bytes_;    // what was asked for
  std::span<std::byte> mapping_;  // whole pages around it, as the system gave them
  std::vector<threads::Grant> grants_;
};

}  // namespace terracut::memory
