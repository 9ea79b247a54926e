// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/memory/memory_region.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <limits>
#include <utility>

#include "tests/support/child_process.hpp"

namespace terracut::memory {
namespace {

std::int64_t minor_faults() {
  rusage usage{};
  ::getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt;
}

TEST(MemoryRegion, HasEveryPageFromTheStart) {
#ifdef TERRACUT_SANITIZED_BUILD
  GTEST_SKIP() << "the sanitizer's shadow memory has page faults of its own";
#endif
  for (const bool large_pages : {false, true}) {
    auto region = MemoryRegion::map(16 << 20, {.lock = false, .large_pages = large_pages});
    ASSERT_TRUE(region.has_value());
    ASSERT_EQ(region->bytes().size(), std::size_t{16} << 20);
    const std::int64_t before = minor_faults();
    for (std::byte& byte : region->bytes()) *const_cast<volatile std::byte*>(&byte) = std::byte{1};
    EXPECT_LT(minor_faults() - before, 16) << "of 4096 pages; large pages: " << large_pages;
  }
}

TEST(MemoryRegion, IsZeroedAndAlignedToItsPages) {
  const auto small = MemoryRegion::map(5'000, {.large_pages = false});
  const auto large = MemoryRegion::map(5'000, {.large_pages = true});
  ASSERT_TRUE(small && large);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(small->bytes().data()) % 4096, 0U);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(large->bytes().data()) % (2U << 20), 0U);
  for (const auto* region : {&*small, &*large}) {
    EXPECT_EQ(region->bytes().size(), 5'000U);
    EXPECT_TRUE(std::all_of(region->bytes().begin(), region->bytes().end(),
                            [](std::byte byte) { return byte == std::byte{0}; }));
  }
}

TEST(MemoryRegion, MovesWithItsMemory) {
  auto first = MemoryRegion::map(100, {});
  ASSERT_TRUE(first.has_value());
  first->bytes()[99] = std::byte{7};
  MemoryRegion second = std::move(*first);
  EXPECT_EQ(second.bytes()[99], std::byte{7});
  MemoryRegion third;
  third = std::move(second);
  EXPECT_EQ(third.bytes()[99], std::byte{7});
}

TEST(MemoryRegion, OfNothingIsNoError) {
  const auto region = MemoryRegion::map(0, {.lock = true});
  ASSERT_TRUE(region.has_value());
  EXPECT_TRUE(region->bytes().empty());
}

TEST(MemoryRegion, IsAnErrorWhenTheSystemHasNotThatMuch) {
  for (const std::size_t bytes :
       {std::numeric_limits<std::size_t>::max(), std::numeric_limits<std::size_t>::max() / 4}) {
    const auto region = MemoryRegion::map(bytes, {});
    ASSERT_FALSE(region.has_value());
    EXPECT_EQ(region.error().code, ErrorCode::kCapacityExceeded);
    EXPECT_THAT(region.error().message, testing::HasSubstr("Cannot allocate memory"));
  }
}

TEST(MemoryRegion, GoesOnUnlockedWithoutTheRightAndSaysHowToGetIt) {
#ifdef TERRACUT_SANITIZED_BUILD
  GTEST_SKIP() << "sanitizers pretend that locking succeeds";
#endif
  const auto check = []() -> std::string {
    const rlimit limit{.rlim_cur = 1 << 16, .rlim_max = 1 << 16};
    if (::setrlimit(RLIMIT_MEMLOCK, &limit) != 0) return "setrlimit failed";
    if (!test::give_up_rights()) return "could not give up rights";
    const auto region = MemoryRegion::map(1 << 20, {.lock = true, .large_pages = false});
    if (!region) return region.error().message;
    if (region->bytes().size() != 1 << 20) return "no memory";
    if (region->grants().size() != 1) return "one answer expected";
    const threads::Grant& grant = region->grants()[0];
    if (grant.granted || (grant.error_number != ENOMEM && grant.error_number != EPERM)) {
      return "not refused: " + threads::to_line(grant);
    }
    if (grant.mend.find("setcap") == std::string::npos)
      return "no command: " + threads::to_line(grant);
    return "";
  };
  EXPECT_EQ(test::in_child_process(check), "");
}

}  // namespace
}  // namespace terracut::memory
