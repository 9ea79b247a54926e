// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// glibc lets a program define malloc itself and reach the real one under another name, so that
// every way to the heap is counted, not operator new alone.
#include "allocation_counter.hpp"

#include <cstddef>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TERRACUT_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TERRACUT_SANITIZED 1
#endif
#endif

namespace {
thread_local std::uint64_t allocations = 0;
}

namespace terracut::test {

std::uint64_t allocations_of_this_thread() noexcept {
  return allocations;
}

#if defined(TERRACUT_SANITIZED) || !defined(__GLIBC__)
bool allocations_are_counted() noexcept {
  return false;
}
#else
bool allocations_are_counted() noexcept {
  return true;
}
#endif

}  // namespace terracut::test

#if !defined(TERRACUT_SANITIZED) && defined(__GLIBC__)
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  ++allocations;
  return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
}
#endif
