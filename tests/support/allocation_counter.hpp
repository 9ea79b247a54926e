// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>

namespace terracut::test {

/// Heap allocations (malloc, calloc, realloc, operator new in any form) made by the calling thread
/// since the program started. Link tests/support/allocation_counter.cpp into the test.
[[nodiscard]] std::uint64_t allocations_of_this_thread() noexcept;

/// False under sanitizers, which bring their own allocator: such tests then skip.
[[nodiscard]] bool allocations_are_counted() noexcept;

}  // namespace terracut::test
