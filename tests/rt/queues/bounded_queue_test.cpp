// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/queues/bounded_queue.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <thread>
#include <vector>

namespace terracut::queues {
namespace {

constexpr std::chrono::nanoseconds kNoPatience{0};
constexpr std::chrono::hours kPatience{1};

TEST(BoundedQueue, HandsValuesOnInTheirOrderUntilItIsFull) {
  BoundedQueue<int> queue(2);
  EXPECT_TRUE(queue.push(1));
  EXPECT_TRUE(queue.push(2));
  EXPECT_FALSE(queue.push(3));
  EXPECT_EQ(queue.pop(kNoPatience), 1);
  EXPECT_TRUE(queue.push(4));
  EXPECT_EQ(queue.pop(kNoPatience), 2);
  EXPECT_EQ(queue.pop(kNoPatience), 4);
  EXPECT_EQ(queue.pop(kNoPatience), std::nullopt);
}

TEST(BoundedQueue, GivesBackTheOldestThatANewOnePushesOut) {
  BoundedQueue<std::unique_ptr<int>> queue(1);
  EXPECT_FALSE(queue.push_out(std::make_unique<int>(1)));
  const auto oldest = queue.push_out(std::make_unique<int>(2));
  ASSERT_TRUE(oldest);
  EXPECT_EQ(**oldest, 1);
  EXPECT_EQ(**queue.pop(kNoPatience), 2);
}

TEST(BoundedQueue, GivesWhatIsLeftWhenItIsClosedAndTakesNothingMore) {
  BoundedQueue<int> queue(2);
  EXPECT_TRUE(queue.push(1));
  queue.close();
  EXPECT_FALSE(queue.push(2));
  EXPECT_EQ(queue.push_out(3), 3);
  EXPECT_FALSE(queue.is_over());
  EXPECT_EQ(queue.pop(kPatience), 1);
  EXPECT_TRUE(queue.is_over());
  EXPECT_EQ(queue.pop(kPatience), std::nullopt) << "without waiting";
}

TEST(BoundedQueue, CarriesValuesFromOneThreadToAnother) {
  BoundedQueue<int> queue(1000);
  std::vector<int> got;
  std::jthread taker([&] {
    while (auto value = queue.pop(kPatience)) got.push_back(*value);
  });
  for (int i = 0; i < 1000; ++i) EXPECT_TRUE(queue.push(i));
  queue.close();
  taker.join();
  ASSERT_EQ(got.size(), 1000U);
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(got[static_cast<std::size_t>(i)], i);
}

}  // namespace
}  // namespace terracut::queues
