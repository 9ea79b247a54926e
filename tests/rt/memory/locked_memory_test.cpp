// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Everything here happens in child processes: what is tested holds for a whole process.
#include "rt/memory/locked_memory.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include "tests/support/child_process.hpp"

namespace terracut::memory {
namespace {

std::int64_t minor_faults() {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt;
}

bool set_lock_limit(rlim_t soft, rlim_t hard) {
  const rlimit limit{.rlim_cur = soft, .rlim_max = hard};
  return ::setrlimit(RLIMIT_MEMLOCK, &limit) == 0;
}

/// Everybody may lower the hard limit, hardly anybody may raise it; finite, to be exceeded.
rlim_t hard_lock_limit() {
  rlimit limit{};
  ::getrlimit(RLIMIT_MEMLOCK, &limit);
  return std::min(limit.rlim_max, rlim_t{1} << 30);
}

/// Only the grant for locking.
threads::Grant lock(std::size_t later) {
  return hold_memory({.later = later, .thread_stack = 0, .heap = 0, .stack = 0}).at(0);
}

class LockedMemory : public testing::Test {
 protected:
  void SetUp() override {
#ifdef TERRACUT_SANITIZED_BUILD
    GTEST_SKIP() << "sanitizers pretend that locking succeeds, and replace the heap";
#endif
  }
};

TEST_F(LockedMemory, IsCountedByTheSystemWhenGrantedAndExplainedWhenNot) {
  EXPECT_EQ(test::in_child_process([]() -> std::string {
              const threads::Grant grant = lock(64 << 20);
              if (grant.granted) return locked_bytes() > (1 << 20) ? "" : "nothing is locked";
              if (grant.error_number == 0) return "refused without a reason";
              return grant.mend.find("setcap") != std::string::npos ? "" : threads::to_line(grant);
            }),
            "");
}

TEST_F(LockedMemory, HasNoPageFaultsInWhatIsTakenLater) {
  const std::string complaint = test::in_child_process([]() -> std::string {
    if (!lock(64 << 20).granted) return "skip";
    constexpr std::size_t kBytes = std::size_t{8} << 20;
    void* block =
        ::mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (block == MAP_FAILED) return "no memory";
    const std::int64_t before = minor_faults();
    for (std::size_t at = 0; at < kBytes; at += 4096) static_cast<volatile char*>(block)[at] = 1;
    const std::int64_t faults = minor_faults() - before;
    return faults < 16 ? "" : std::to_string(faults) + " faults";
  });
  if (complaint == "skip") GTEST_SKIP() << "no right to lock memory here";
  EXPECT_EQ(complaint, "");
}

TEST_F(LockedMemory, IsRefusedInGoodOrderWithoutTheRight) {
  EXPECT_EQ(test::in_child_process([]() -> std::string {
              if (!set_lock_limit(0, 0) || !test::give_up_rights()) return "could not give up";
              const threads::Grant grant = lock(64 << 20);
              if (grant.granted || grant.error_number != EPERM) return threads::to_line(grant);
              if (grant.mend.find("memlock unlimited") == std::string::npos)
                return threads::to_line(grant);
              return "";
            }),
            "");
}

TEST_F(LockedMemory, RaisesTheSoftLimitByItself) {
  const std::string complaint = test::in_child_process([]() -> std::string {
    if (!set_lock_limit(0, hard_lock_limit())) return "could not set limits";
    if (!test::give_up_rights()) return "could not give up rights";
    const threads::Grant grant = lock(64 << 10);
    if (grant.error_number == ENOMEM) return "skip";
    return grant.granted ? "" : threads::to_line(grant);
  });
  if (complaint == "skip") GTEST_SKIP() << "this program is larger than may be locked here";
  EXPECT_EQ(complaint, "");
}

/// With a limit that what is there fits but what comes does not, a later thread would not start.
TEST_F(LockedMemory, LeavesLaterMemoryUnlockedRatherThanHaveItFail) {
  const std::string complaint = test::in_child_process([]() -> std::string {
    const rlim_t hard = hard_lock_limit();
    if (!set_lock_limit(hard, hard)) return "could not set limits";
    if (!test::give_up_rights()) return "could not give up rights";
    const threads::Grant grant = lock(hard);
    if (grant.error_number == ENOMEM) return "skip";
    if (grant.granted || grant.error_number != EAGAIN) return threads::to_line(grant);
    if (locked_bytes() == 0) return "what is there is not locked";
    void* block = ::mmap(nullptr, hard, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    return block == MAP_FAILED ? "later memory fails" : "";
  });
  if (complaint == "skip") GTEST_SKIP() << "this program is larger than may be locked here";
  EXPECT_EQ(complaint, "");
}

TEST_F(LockedMemory, KeepsAHeapThatDoesNotFaultAgain) {
  EXPECT_EQ(test::in_child_process([]() -> std::string {
              const auto grants =
                  hold_memory({.lock = false, .thread_stack = 0, .heap = 16 << 20, .stack = 0});
              if (grants.size() != 1 || !grants[0].granted) return "not granted";
              const std::int64_t before = minor_faults();
              for (int round = 0; round < 10; ++round) {
                // Larger than what malloc otherwise takes from the system and gives back.
                constexpr std::size_t kBytes = std::size_t{8} << 20;
                const std::unique_ptr<volatile char[]> block(new volatile char[kBytes]);
                for (std::size_t at = 0; at < kBytes; at += 4096) block[at] = 1;
              }
              const std::int64_t faults = minor_faults() - before;
              return faults < 64 ? "" : std::to_string(faults) + " faults";
            }),
            "");
}

TEST_F(LockedMemory, GivesThreadsTheStackThatWasAsked) {
  EXPECT_EQ(test::in_child_process([]() -> std::string {
              constexpr std::size_t kStack = std::size_t{512} << 10;
              (void)hold_memory({.lock = false, .thread_stack = kStack, .heap = 0, .stack = 0});
              std::size_t size = 0;
              std::thread([&] {
                ::pthread_attr_t attributes;
                ::pthread_getattr_np(::pthread_self(), &attributes);
                ::pthread_attr_getstacksize(&attributes, &size);
                ::pthread_attr_destroy(&attributes);
              }).join();
              return size == kStack ? "" : std::to_string(size) + " bytes";
            }),
            "");
}

[[gnu::noinline]] void use_stack() {
  [[maybe_unused]] volatile char frame[200 << 10];
  for (std::size_t at = sizeof frame; at > 0; at -= 1024) frame[at - 1024] = 1;
}

TEST_F(LockedMemory, HasNoPageFaultsInAStackMadePresent) {
  std::string complaint;
  std::thread([&] {  // a new stack, none of it touched yet
    if (prefault_stack(256 << 10) < 256 << 10) complaint = "not touched";
    const std::int64_t before = minor_faults();
    use_stack();
    const std::int64_t faults = minor_faults() - before;
    if (faults > 4) complaint += std::to_string(faults) + " faults";
  })
      .join();
  EXPECT_EQ(complaint, "");
}

TEST_F(LockedMemory, TouchesNoMoreStackThanThereIs) {
  std::size_t touched = 0;
  ::pthread_attr_t attributes;
  ::pthread_attr_init(&attributes);
  ::pthread_attr_setstacksize(&attributes, 256 << 10);
  ::pthread_t thread{};
  const auto run = [](void* result) -> void* {
    *static_cast<std::size_t*>(result) = prefault_stack(std::size_t{1} << 40);
    return nullptr;
  };
  ASSERT_EQ(::pthread_create(&thread, &attributes, run, &touched), 0);
  ::pthread_join(thread, nullptr);
  ::pthread_attr_destroy(&attributes);
  EXPECT_GT(touched, 64U << 10);
  EXPECT_LT(touched, 256U << 10);
}

}  // namespace
}  // namespace terracut::memory
