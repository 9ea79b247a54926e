// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/memory/locked_memory.hpp"

#include <malloc.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

namespace terracut::memory {
namespace {

std::string in_kib(std::size_t bytes) {
  return std::to_string(bytes >> 10) + " KiB";
}

std::size_t page_size() {
  return static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

/// Makes the heap keep freed memory and serve large blocks itself, instead of returning them to the
/// system and faulting them in again.
threads::Grant keep_heap(std::size_t bytes) {
  threads::Grant grant{.asked = "a heap that never shrinks, " + in_kib(bytes) + " of it present"};
#ifdef __GLIBC__
  grant.granted = ::mallopt(M_TRIM_THRESHOLD, -1) == 1 && ::mallopt(M_MMAP_MAX, 0) == 1;
#endif
  if (!grant.granted) {
    grant.error_number = ENOTSUP;
    grant.in_force = "freed memory may go back to the system";
    grant.mend = "needs the GNU C library";
    return grant;
  }
  void* block = std::malloc(bytes);
  if (block == nullptr) {
    grant.granted = false;
    grant.error_number = ENOMEM;
    grant.in_force = "freed memory is kept, but none was made present";
    grant.mend = "free memory on this machine, or raise the limit of the container";
    return grant;
  }
  auto* bytes_of_it = static_cast<volatile char*>(block);
  for (std::size_t at = 0; at < bytes; at += page_size()) bytes_of_it[at] = 1;
  std::free(block);
  grant.in_force = "freed memory is kept";
  return grant;
}

threads::Grant set_thread_stack(std::size_t bytes) {
  threads::Grant grant{.asked = "stacks of " + in_kib(bytes) + " for threads"};
  ::pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  grant.error_number = ::pthread_attr_setstacksize(&attributes, bytes);
  if (grant.error_number == 0) grant.error_number = ::pthread_setattr_default_np(&attributes);
  ::pthread_attr_destroy(&attributes);
  grant.granted = grant.error_number == 0;
  grant.in_force = grant.granted ? "holds for threads created from now on" : "the default stays";
  if (!grant.granted) grant.mend = "ask for at least 16 KiB and whole pages";
  return grant;
}

/// Returns 0 if `bytes` more could be mapped once all future memory is locked, else errno. Maps
/// memory without access as a trial: it counts against the limit but costs nothing.
int try_later(std::size_t bytes) {
  if (bytes == 0) return 0;
  void* trial = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (trial == MAP_FAILED) return errno;
  ::munmap(trial, bytes);
  return 0;
}

threads::Grant lock_all(std::size_t later) {
  threads::Grant grant{.asked = "locking of all memory, now and later"};
  // The soft limit is only the shell's default: a process may raise it to the hard limit. If the
  // system refuses that, mlockall() below fails.
  if (rlimit limit{}; ::getrlimit(RLIMIT_MEMLOCK, &limit) == 0) {
    limit.rlim_cur = limit.rlim_max;
    (void)::setrlimit(RLIMIT_MEMLOCK, &limit);
  }
  if (::mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    grant.error_number = errno;
    grant.in_force = "pages can be swapped out and faulted in again, each a delay";
    grant.mend = threads::mend_memory_lock();
    return grant;
  }
  grant.error_number = try_later(later);
  if (grant.error_number != 0) {
    // Locks present memory again, and stops locking future memory.
    (void)::mlockall(MCL_CURRENT);
    grant.in_force = "only the memory there is now is locked, for the limit has no room for " +
                     in_kib(later) + " more";
    grant.mend = threads::mend_memory_lock();
    return grant;
  }
  grant.granted = true;
  grant.in_force = in_kib(locked_bytes()) + " locked so far";
  return grant;
}

threads::Grant make_stack_present(std::size_t bytes) {
  threads::Grant grant{.asked = in_kib(bytes) + " of stack present"};
  const std::size_t touched = prefault_stack(bytes);
  grant.granted = touched >= bytes;
  grant.in_force = in_kib(touched) + " are present";
  if (!grant.granted) {
    grant.error_number = ENOMEM;
    grant.mend = "give the thread a larger stack ('ulimit -s' for the first thread)";
  }
  return grant;
}

/// Returns how many bytes of the calling thread's stack lie below `here`; 0 if unknown.
std::size_t stack_left_below(const volatile char* here) {
  ::pthread_attr_t attributes;
  if (::pthread_getattr_np(::pthread_self(), &attributes) != 0) return 0;
  void* lowest = nullptr;
  std::size_t size = 0;
  ::pthread_attr_getstack(&attributes, &lowest, &size);
  ::pthread_attr_destroy(&attributes);
  const auto bottom = reinterpret_cast<std::uintptr_t>(lowest);
  const auto top = reinterpret_cast<std::uintptr_t>(here);
  return top > bottom ? top - bottom : 0;
}

/// Touches `bytes` of stack. Not inlined, so that its stack frame ends with the call. The size of
/// its array is unknown at compile time, or the compiler would leave out pages that nobody uses.
[[gnu::noinline]] void touch_stack(std::size_t bytes) {
  auto* lowest = static_cast<volatile char*>(__builtin_alloca(bytes));
  const std::size_t page = page_size();
  // Touches from high to low addresses, as the kernel expects a stack to grow.
  for (std::size_t left = bytes; left > 0; left -= std::min(left, page)) lowest[left - 1] = 1;
  lowest[0] = 1;
}

}  // namespace

std::size_t prefault_stack(std::size_t bytes) {
  // Room for guard pages and a signal handler.
  constexpr std::size_t kSpare = std::size_t{64} << 10;
  const volatile char here = 0;
  const std::size_t left = stack_left_below(&here);
  const std::size_t touched = std::min(bytes, left > kSpare ? left - kSpare : 0);
  if (touched > 0) touch_stack(touched);
  return touched;
}

std::size_t locked_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word != "VmLck:") continue;
    std::size_t kib = 0;
    status >> kib;
    return kib << 10;
  }
  return 0;
}

std::vector<threads::Grant> hold_memory(const MemoryRequest& request) {
  std::vector<threads::Grant> grants;
  if (request.heap > 0) grants.push_back(keep_heap(request.heap));
  if (request.thread_stack > 0) grants.push_back(set_thread_stack(request.thread_stack));
  if (request.lock) grants.push_back(lock_all(request.later));
  if (request.stack > 0) grants.push_back(make_stack_present(request.stack));
  return grants;
}

}  // namespace terracut::memory
