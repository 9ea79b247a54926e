// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/memory/used_again.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <vector>

namespace terracut::memory {
namespace {

TEST(UsedAgain, GivesOutWhatWasDroppedAndNothingThatIsHeld) {
  UsedAgain<int> numbers;
  auto first = numbers.take();
  const auto second = numbers.take();
  EXPECT_NE(first, second);
  const int* const place = first.get();
  *first = 7;
  first.reset();
  const auto third = numbers.take();
  EXPECT_EQ(third.get(), place);
  EXPECT_EQ(*third, 7);
}

TEST(UsedAgain, ThingsOutliveIt) {
  std::optional<UsedAgain<int>> numbers(std::in_place);
  const auto one = numbers->take();
  numbers.reset();
  *one = 1;
}

// With ThreadSanitizer this is the test that a last reader is done before the next write.
TEST(UsedAgain, AReaderIsDoneBeforeTheNextWrites) {
  UsedAgain<std::vector<int>> rooms;
  std::shared_ptr<const std::vector<int>> newest;
  std::mutex mutex;
  std::atomic<bool> over = false;
  std::atomic<int> torn = 0;
  std::jthread reader([&] {
    while (!over) {
      std::shared_ptr<const std::vector<int>> read;
      {
        const std::scoped_lock lock(mutex);
        read = newest;
      }
      if (read && std::set<int>(read->begin(), read->end()).size() != 1) ++torn;
    }
  });
  for (int n = 0; n < 20'000; ++n) {
    const auto room = rooms.take();
    room->assign(20, n);
    const std::scoped_lock lock(mutex);
    newest = room;
  }
  over = true;
  reader.join();
  EXPECT_EQ(torn, 0);
}

}  // namespace
}  // namespace terracut::memory
