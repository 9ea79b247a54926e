// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/threads/background_thread.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "rt/caught.hpp"

namespace terracut::threads {
namespace {

TEST(BackgroundThread, AnExceptionEndsTheWorkAndNotTheProgram) {
  std::string why;
  BackgroundThread thread([] { throw std::runtime_error("no more threads"); },
                          [&](std::string_view what) { why = what; });
  EXPECT_TRUE(thread.ends_within(std::chrono::hours(1)));
  EXPECT_EQ(why, "no more threads");
}

TEST(BackgroundThread, WorkThatEndsByItselfHasNotFailed) {
  std::string why;
  BackgroundThread thread([] {}, [&](std::string_view what) { why = what; });
  EXPECT_TRUE(thread.ends_within(std::chrono::hours(1)));
  EXPECT_EQ(why, "");
}

TEST(Caught, MakesAnErrorOfAnExceptionAndLeavesOthersAsTheyAre) {
  EXPECT_TRUE(rt::caught([]() -> Status { return {}; }));
  const Status failed = rt::caught([] { return Status(fail(ErrorCode::kNotFound, "no file")); });
  EXPECT_EQ(failed.error().code, ErrorCode::kNotFound);
  const Status thrown = rt::caught([]() -> Status { throw std::bad_alloc(); });
  EXPECT_EQ(thrown.error().code, ErrorCode::kCapacityExceeded);
  EXPECT_EQ(thrown.error().message, "out of memory");
}

}  // namespace
}  // namespace terracut::threads
