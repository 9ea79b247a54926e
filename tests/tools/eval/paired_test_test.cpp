// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/eval/paired_test.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace terracut::evaluation {
namespace {

TEST(SignedRankTest, IsExactForFewPairs) {
  // All of n differences positive: only one of 2^n ways on either side is as extreme.
  EXPECT_DOUBLE_EQ(signed_rank_test(std::vector{1.0, 2.0, 3.0, 4.0, 5.0}).p, 2.0 / 32);
  // Rank 1 negative: positive sums of 0 and 1 on the small side.
  EXPECT_DOUBLE_EQ(signed_rank_test(std::vector{-1.0, 2.0, 3.0, 4.0, 5.0}).p, 4.0 / 32);
  EXPECT_DOUBLE_EQ(signed_rank_test(std::vector{-1.0, 2.0}).p, 1.0);
}

TEST(SignedRankTest, GivesTheValueOfATextbook) {
  // Hollander & Wolfe, Hamilton depression scale, table 3.1: T+ = 5 of 9 pairs, one-sided 0.0195.
  const std::vector differences{-0.952, 0.147, -1.022, -0.43, -0.62, -0.59, -0.49, 0.08, -0.01};
  EXPECT_NEAR(signed_rank_test(differences).p, 2 * 0.01953125, 1e-12);
}

TEST(SignedRankTest, LeavesZerosOutAndSharesRanksAmongTies) {
  const auto with_zeros = signed_rank_test(std::vector{0.0, 1.0, 0.0, 2.0, 3.0});
  EXPECT_DOUBLE_EQ(with_zeros.p, signed_rank_test(std::vector{1.0, 2.0, 3.0}).p);
  EXPECT_EQ(with_zeros.pairs, 5U);
  EXPECT_EQ(with_zeros.better, 3U);
  EXPECT_EQ(with_zeros.worse, 0U);
  // Ties by the normal approximation: n = 4, mean 5, variance 7.5 - 60/48, T = 0.
  EXPECT_NEAR(signed_rank_test(std::vector{1.0, 1.0, 1.0, 1.0}).p, 0.07186, 1e-5);
}

TEST(SignedRankTest, AgreesWithItselfWhereTheApproximationTakesOver) {
  std::vector<double> differences;
  for (int i = 1; i <= 25; ++i) differences.push_back(i % 3 == 0 ? -i : i);
  const double exact = signed_rank_test(differences).p;
  differences.push_back(1e-9);  // a 26th, of the lowest rank
  EXPECT_NEAR(signed_rank_test(differences).p, exact, 0.02);
}

TEST(SignedRankTest, FindsNothingInNothing) {
  EXPECT_EQ(signed_rank_test({}).p, 1);
  EXPECT_EQ(signed_rank_test(std::vector{0.0, 0.0}).p, 1);
}

TEST(SignFlipTest, CountsTheWaysToAsLargeAMean) {
  EXPECT_DOUBLE_EQ(sign_flip_test(std::vector{1.0, 2.0, 3.0}).p, 2.0 / 8);
  EXPECT_DOUBLE_EQ(sign_flip_test(std::vector{-1.0, 2.0, 3.0}).p, 4.0 / 8);
  EXPECT_DOUBLE_EQ(sign_flip_test(std::vector{-1.0, 2.0, 3.0}).mean, 4.0 / 3);
  EXPECT_DOUBLE_EQ(sign_flip_test(std::vector{1.0, -1.0}).p, 1);
  EXPECT_THROW((void)sign_flip_test(std::vector<double>(21, 1.0)), std::invalid_argument);
}

}  // namespace
}  // namespace terracut::evaluation
