// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "rt/memory/fixed_memory.hpp"

namespace terracut::min_cut {

/// A ring buffer of node indices, open at both ends. Holds at least `capacity` indices; the caller
/// queues no node twice, so the buffer never overflows.
class NodeQueue {
 public:
  NodeQueue(std::string_view part, std::size_t capacity, memory::FixedMemory& memory)
      : ring_(memory.take<std::uint32_t>(part, std::bit_ceil(capacity + 1))),
        mask_(static_cast<std::uint32_t>(ring_.size() - 1)) {}

  void clear() noexcept { front_ = back_ = 0; }
  [[nodiscard]] bool empty() const noexcept { return front_ == back_; }
  void push_back(std::uint32_t node) noexcept { ring_[back_++ & mask_] = node; }
  void push_front(std::uint32_t node) noexcept { ring_[--front_ & mask_] = node; }
  [[nodiscard]] std::uint32_t pop_front() noexcept { return ring_[front_++ & mask_]; }

 private:
  std::span<std::uint32_t> ring_;
  std::uint32_t mask_;
  std::uint32_t front_ = 0, back_ = 0;
};

}  // namespace terracut::min_cut
