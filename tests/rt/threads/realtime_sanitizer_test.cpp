// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// That a build with -fsanitize=realtime ends a program that breaks the rule, or a run that finds
// nothing would prove nothing.
#include <gtest/gtest.h>
#include <unistd.h>

#include <mutex>
#include <vector>

#include "rt/threads/nonblocking.hpp"

namespace terracut::threads {
namespace {

/// Calls what the compiler cannot see through, and so would refuse.
void call(void (*hidden)()) noexcept TERRACUT_NONBLOCKING {
#ifdef TERRACUT_REALTIME_SANITIZER
#pragma clang diagnostic push
#pragma clang diagnostic ignored "-Wfunction-effects"
#endif
  hidden();
#ifdef TERRACUT_REALTIME_SANITIZER
#pragma clang diagnostic pop
#endif
}

void allocate() {
  std::vector<int> numbers(100);
  static_cast<void>(static_cast<volatile int*>(numbers.data())[0]);
}

void lock() {
  static std::mutex mutex;
  const std::lock_guard held(mutex);
}

void sleep() {
  ::usleep(1);
}

class RealtimeSanitizer : public testing::Test {
 protected:
  void SetUp() override {
#ifndef TERRACUT_REALTIME_SANITIZER
    GTEST_SKIP() << "only a build with -fsanitize=realtime stops such a program";
#endif
  }
};

TEST_F(RealtimeSanitizer, EndsAProgramWhoseMarkedFunctionAllocates) {
  EXPECT_DEATH(call(allocate), "RealtimeSanitizer: unsafe-library-call");
}

TEST_F(RealtimeSanitizer, EndsAProgramWhoseMarkedFunctionLocks) {
  EXPECT_DEATH(call(lock), "RealtimeSanitizer: unsafe-library-call");
}

TEST_F(RealtimeSanitizer, EndsAProgramWhoseMarkedFunctionSleeps) {
  EXPECT_DEATH(call(sleep), "RealtimeSanitizer: unsafe-library-call");
}

TEST_F(RealtimeSanitizer, LetsTrustedCallsPassAndNothingAfterThem) {
  const auto trusted_then_not = []() noexcept TERRACUT_NONBLOCKING {
    trusted_call(allocate);
    call(allocate);
  };
  const auto trusted = []() noexcept TERRACUT_NONBLOCKING { trusted_call(allocate); };
  trusted();
  EXPECT_DEATH(trusted_then_not(), "RealtimeSanitizer: unsafe-library-call");
}

}  // namespace
}  // namespace terracut::threads
