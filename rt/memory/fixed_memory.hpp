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

/// All memory of the per-frame path, taken once at start-up and held until the end.
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
  static constexpr std::size_t kAlignment = 64;  ///< Bytes: a cache line, or any SIMD register.

  struct Part {
    std::string name;
    std::size_t bytes = 0;
  };

  FixedMemory() = default;
  FixedMemory(const FixedMemory&) = delete;
  FixedMemory& operator=(const FixedMemory&) = delete;

  /// Takes arrays from one region of `bytes` from now on, in the order they are taken, without
  /// gaps. `bytes` is the total_bytes() of a dry run. Every page of the region is present on
  /// return. Locking and large pages are asked for as `request` says; the grants are returned, and
  /// a refusal is no error. Errors: kInvalidArgument if arrays were taken already or a region
  /// exists; kCapacityExceeded if the system has not that much memory.
  [[nodiscard]] Expected<std::vector<threads::Grant>> reserve(std::size_t bytes,
                                                              const RegionRequest& request);

  /// Returns `count` zeroed elements, aligned to kAlignment. Sizes are rounded up to whole cache
  /// lines. The span stays valid, at the same address, as long as this object lives. An array that
  /// does not fit the region comes from the heap, and within_plan() reports it.
  template <class T>
  [[nodiscard]] std::span<T> take(std::string_view part, std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T> && std::is_trivially_copyable_v<T>);
    return {static_cast<T*>(take_bytes(part, count * sizeof(T))), count};
  }

  [[nodiscard]] std::span<const Part> parts() const noexcept { return parts_; }
  [[nodiscard]] std::size_t total_bytes() const noexcept;

  /// Checks, once everything is built, that no more was taken than reserved: kCapacityExceeded
  /// names the first part that did not fit and the size that would have held all. Always success
  /// without a region.
  [[nodiscard]] Status within_plan() const;

  /// Returns the reserved region; empty before reserve(). For tests and reports.
  [[nodiscard]] std::span<const std::byte> region() const noexcept { return region_.bytes(); }

 private:
  struct Release {
    void operator()(std::byte* block) const noexcept {
      ::operator delete (block, std::align_val_t{kAlignment});
    }
  };

  [[nodiscard]] void* take_bytes(std::string_view part, std::size_t bytes);
  [[nodiscard]] std::byte* from_heap(std::size_t bytes);

  std::vector<Part> parts_;
  std::vector<std::unique_ptr<std::byte, Release>> blocks_;  // on the heap
  MemoryRegion region_;
  std::size_t used_ = 0;         // bytes of the region in use
  std::string first_too_large_;  // the first part that did not fit the region
};

}  // namespace terracut::memory
