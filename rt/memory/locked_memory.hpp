// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <vector>

#include "rt/threads/grant.hpp"

namespace terracut::memory {

/// What a process does about its memory before its real-time threads start. Sizes are in bytes; 0
/// skips that step.
struct MemoryRequest {
  /// Locks all memory of the process, present and future.
  bool lock = true;
  /// The size of memory taken later: stacks of threads, a frame region. If the limit has no room
  /// for it, only present memory is locked; else a later start of a thread would fail.
  std::size_t later = std::size_t{64} << 20;
  /// The stack of threads created later, unless they ask otherwise. Locked stacks are present in
  /// full from the start, so the usual 8 MiB a thread are too much.
  std::size_t thread_stack = std::size_t{1} << 20;
  /// The heap that is made present and kept for allocations during start-up.
  std::size_t heap = std::size_t{4} << 20;
  /// The part of the calling thread's stack that is made present.
  std::size_t stack = std::size_t{256} << 10;
};

/// Makes page faults unlikely from here on: the heap keeps its memory, memory is made present and
/// locked. Call it first in main, before threads start. The program can run whatever the system
/// refuses: the grants say what holds instead and how to mend it. Start-up only, from the main
/// thread.
[[nodiscard]] std::vector<threads::Grant> hold_memory(const MemoryRequest& request);

/// Touches up to `bytes` of the calling thread's stack below here, so that calls that deep do not
/// fault later. Returns the bytes touched: fewer if the stack ends before. Start-up only.
std::size_t prefault_stack(std::size_t bytes);

/// Returns the locked memory of this process in bytes; 0 if the system does not tell. Blocks.
[[nodiscard]] std::size_t locked_bytes();

}  // namespace terracut::memory
