// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <vector>

#include "rt/threads/grant.hpp"

namespace terracut::memory {

/// What a process does about its memory before its real-time threads start. Sizes are bytes; 0
/// leaves that point out.
struct MemoryRequest {
  /// Lock all memory of the process, and what it takes later.
  bool lock = true;
  /// What will be taken after this: stacks of threads, a frame region. If a limit has no room for
  /// so much locked memory, only what is there already is locked; else a later start of a thread
  /// would fail.
  std::size_t later = std::size_t{64} << 20;
  /// Stack of threads created later, unless they ask otherwise. Once memory is locked a stack is
  /// there in full from the start, so the usual 8 MiB a thread are too much.
  std::size_t thread_stack = std::size_t{1} << 20;
  /// Heap that is made present and kept for those who allocate while starting.
  std::size_t heap = std::size_t{4} << 20;
  /// Stack of the calling thread that is made present.
  std::size_t stack = std::size_t{256} << 10;
};

/// Makes page faults unlikely from here on: the heap keeps what it has got, memory is made present
/// and locked. Call it first thing in main, before threads start. Whatever the system refuses, the
/// program can run: the grants say what holds instead and what would mend it.
/// Start-up only, from the main thread.
[[nodiscard]] std::vector<threads::Grant> hold_memory(const MemoryRequest& request);

/// Touches up to `bytes` of the calling thread's stack below here, so that calls that deep do not
/// fault later. Returns how many were touched: fewer if the stack ends before. Start-up only.
std::size_t prefault_stack(std::size_t bytes);

/// Locked memory of this process, bytes, as the system counts it; 0 when it does not tell. Blocks.
[[nodiscard]] std::size_t locked_bytes();

}  // namespace terracut::memory
