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

namespace terracut::rt {

/// All memory of the per-frame path, taken once at start-up and never given back before the end.
///
/// Components take their arrays in their constructors, each under the name of a part, so that
/// `terracut plan` can print what every part costs; after start nothing is taken any more.
/// Not real-time safe, not thread-safe: start-up only. Throws std::bad_alloc when memory is short.
class FixedMemory {
 public:
  static constexpr std::size_t kAlignment = 64;  ///< Bytes; a cache line, and any SIMD register.

  struct Part {
    std::string name;
    std::size_t bytes = 0;
  };

  FixedMemory() = default;
  FixedMemory(const FixedMemory&) = delete;
  FixedMemory& operator=(const FixedMemory&) = delete;

  /// `count` zeroed elements, aligned to kAlignment. Sizes are rounded up to whole cache lines.
  /// The span stays valid, at the same address, as long as this object lives.
  template <class T>
  [[nodiscard]] std::span<T> take(std::string_view part, std::size_t count) {
    static_assert(std::is_trivially_destructible_v<T> && std::is_trivially_copyable_v<T>);
    return {static_cast<T*>(take_bytes(part, count * sizeof(T))), count};
  }

  [[nodiscard]] std::span<const Part> parts() const noexcept { return parts_; }
  [[nodiscard]] std::size_t total_bytes() const noexcept;

 private:
  struct Release {
    void operator()(std::byte* block) const noexcept {
      ::operator delete(block, std::align_val_t{kAlignment});
    }
  };

  [[nodiscard]] void* take_bytes(std::string_view part, std::size_t bytes);

  std::vector<Part> parts_;
  std::vector<std::unique_ptr<std::byte, Release>> blocks_;
};

}  // namespace terracut::rt
