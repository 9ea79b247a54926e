// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "rt/error.hpp"
#include "rt/memory/memory_region.hpp"
#include "rt/threads/grant.hpp"

namespace terracut::memory {

/// Holds all memory of the per-frame path, taken once at start-up and kept until the end.
///
/// Components take their arrays in their constructors, each under the name of a part, so that
/// `terracut plan` can print the cost of every part; nothing is taken after start-up.
///
/// By default every array is a block of its own on the heap, which suits tools and tests. A program
/// with a deadline plans first and then takes everything from one region:
///
///     FixedMemory plan;                       // a dry run on the heap
///     { Segmenter trial(..., plan); }
///     FixedMemory memory;
///     auto grants = memory.reserve(plan.total_bytes(), {.lock = true});
///     Segmenter segmenter(..., memory);           // the same objects, now side by side
///     if (auto status = memory.within_plan(); !status) ...   // start-up error
///
/// Not real-time safe, not thread-safe: start-up only. Throws std::bad_alloc when memory is short.
class FixedMemory {
 public:
  /// Alignment of every array in bytes: a cache line, or any SIMD register.
  static constexpr std::size_t kAlignment = 64;

  struct Part {
    std::string name;
    std::size_t bytes = 0;
  };

  FixedMemory() = default;
  FixedMemory(const FixedMemory&) = delete;
  FixedMemory& operator=(const FixedMemory&) = delete;

  /// From now on takes arrays from one region of `bytes`, the total_bytes() of a dry run, in the
  /// order in which they are asked for, without gaps. Every page of the region is present on
  /// return. Locks it and asks for large pages as `request` says, and returns the system's answers;
  /// a refusal is no error. Fails with kInvalidArgument if arrays were taken already or a region
  /// exists; kCapacityExceeded if the system has less memory.
  [[nodiscard]] Expected<std::vector<threads::Grant>> reserve(std::size_t bytes,
                                                              const RegionRequest& request);

  /// Returns `count` zeroed elements, aligned to kAlignment. Sizes are rounded up to whole cache
  /// lines. The span stays valid at the same address until this object is destroyed. If the region
  /// is too small for an array, it comes from the heap, and within_plan() reports it.
  template <class T>
  [[nodiscard]] std::span<T> take(std::string_view part, std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T> && std::is_trivially_copyable_v<T>);
    return {static_cast<T*>(take_bytes(part, count * sizeof(T))), count};
  }

  [[nodiscard]] std::span<const Part> parts() const noexcept { return parts_; }
  [[nodiscard]] std::size_t total_bytes() const noexcept;

  /// Checks, once everything is built, that no more was taken than reserved. If more was, fails
  /// with kCapacityExceeded; the message names the first part that did not fit and the size that
  /// would have held all. Without a region always succeeds.
  [[nodiscard]] Status within_plan() const;

  /// Returns the reserved region, for tests and reports; empty before reserve().
  [[nodiscard]] std::span<const std::byte> region() const noexcept { return region_.bytes(); }

 private:
  struct Release {
    void operator()(std::byte* block) const noexcept {
      ::operator delete(block, std::align_val_t{kAlignment});
    }
  };

  [[nodiscard]] void* take_bytes(std::string_view part, std::size_t bytes);
  [[nodiscard]] std::byte* from_heap(std::size_t bytes);

  std::vector<Part> parts_;
  std::vector<std::unique_ptr<std::byte, Release>> blocks_;  // arrays on the heap
  MemoryRegion region_;
  std::size_t used_ = 0;         // bytes of the region in use
  std::string first_too_large_;  // the first part that did not fit the region
};

}  // namespace terracut::memory
