// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/measure/page_faults.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstddef>
#include <thread>

namespace terracut::measure {
namespace {

constexpr std::size_t kPages = 256;

/// Touches memory that was never touched before.
void touch_new_pages() {
  void* block =
      ::mmap(nullptr, kPages * 4096, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(block, MAP_FAILED);
  ::madvise(block, kPages * 4096, MADV_NOHUGEPAGE);
  for (std::size_t page = 0; page < kPages; ++page)
    static_cast<volatile char*>(block)[page * 4096] = 1;
  ::munmap(block, kPages * 4096);
}

TEST(PageFaults, CountsEveryFirstTouch) {
  const PageFaults before = PageFaults::of_this_thread();
  touch_new_pages();
  const PageFaults faults = PageFaults::of_this_thread().since(before);
  EXPECT_GE(faults.minor, std::int64_t{kPages});
  EXPECT_GE(faults.major, 0);
}

TEST(PageFaults, StandsWhileNothingNewIsTouched) {
#ifdef TERRACUT_SANITIZED_BUILD
  GTEST_SKIP() << "the sanitizer's shadow memory has page faults of its own";
#endif
  volatile int work = 0;
  (void)PageFaults::of_this_thread();  // the call itself is present from here on
  const PageFaults before = PageFaults::of_this_thread();
  for (int n = 0; n < 100'000; ++n) work = n;
  const PageFaults faults = PageFaults::of_this_thread().since(before);
  EXPECT_LT(faults.minor, 8) << "the kernel may move a page meanwhile, but not many";
  EXPECT_EQ(faults.major, 0);
  EXPECT_EQ(work, 99'999);
}

TEST(PageFaults, DoesNotCountThoseOfOtherThreads) {
#ifdef TERRACUT_SANITIZED_BUILD
  GTEST_SKIP() << "the sanitizer's shadow memory has page faults of its own";
#endif
  const PageFaults before = PageFaults::of_this_thread();
  std::thread(touch_new_pages).join();
  EXPECT_LT(PageFaults::of_this_thread().since(before).minor, std::int64_t{kPages});
}

}  // namespace
}  // namespace terracut::measure
