// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <vector>

#include "rt/threads/grant.hpp"

namespace terracut::memory {

/// What a process asks for its memory before its real-time threads start. Sizes are in bytes; a
/// size of 0 skips that step.
struct MemoryRequest {
  /// True: locks all memory of the process, present and future.
  bool lock = true;
  /// Size of memory to be taken later: stacks of threads, a frame region. If the lock limit has no
  /// room for this size, only present memory is locked; otherwise a later start of a thread would
  /// fail.
  std::size_t later = std::size_t{64} << 20;
  /// Stack size of threads created later, unless they ask otherwise. A locked stack is present in
  /// full from the start, so the usual 8 MiB per thread are too much.
  std::size_t thread_stack = std::size_t{1} << 20;
  /// Size of the heap to be made present and kept for allocations during start-up.
  std::size_t heap = std::size_t{4} << 20;
  /// Size of the part of the calling thread's stack to be made present.
  std::size_t stack = std::size_t{256} << 10;
};

/// Makes later page faults unlikely: makes memory present, locks it, and keeps the heap from
/// returning it. Call this first in main, before other threads start. The program can run even if
/// the system refuses: the returned grants say what holds instead and how to mend it. Start-up
/// only.
[[nodiscard]] std::vector<threads::Grant> hold_memory(const MemoryRequest& request);

/// Touches up to `bytes` of the calling thread's stack below the current frame, so that later calls
/// of that depth do not fault. Returns the bytes touched: fewer if the stack is smaller. Start-up
/// only.
std::size_t prefault_stack(std::size_t bytes);

/// Returns how many bytes of this process are locked; 0 if the system does not tell. Blocks.
[[nodiscard]] std::size_t locked_bytes();

}  // namespace terracut::memory
