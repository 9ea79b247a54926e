// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/baselines/savitzky_golay.hpp"

#include <gtest/gtest.h>

namespace terracut::baselines {
namespace {

double filtered(const SavitzkyGolay& filter, double (*of)(double), double at) {
  double sum = 0;
  for (int k = -filter.reach(); k <= filter.reach(); ++k) {
    sum += static_cast<double>(filter.weights()[static_cast<std::size_t>(k + filter.reach())]) *
           of(at + k);
  }
  return sum;
}

TEST(SavitzkyGolay, LeavesQuadraticsAsTheyAre) {
  const auto quadratic = [](double x) { return 3.0 - 2.0 * x + 0.5 * x * x; };
  for (int window = 1; window <= SavitzkyGolay::kMaxWindow; window += 2) {
    const SavitzkyGolay filter(window);
    EXPECT_EQ(2 * filter.reach() + 1, window);
    for (const double at : {-4.0, 0.0, 7.0}) {
      EXPECT_NEAR(filtered(filter, quadratic, at), quadratic(at), 1e-4) << window;
    }
  }
}

TEST(SavitzkyGolay, HasThePublishedWeightsOfAWindowOfFive) {
  const SavitzkyGolay filter(5);
  const double published[] = {-3, 12, 17, 12, -3};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(filter.weights()[i], published[i] / 35.0, 1e-6);
  }
}

TEST(SavitzkyGolay, AveragesNoiseTheMoreTheWiderItsWindow) {
  double before = 2;
  for (const int window : {3, 5, 9, 15}) {
    const SavitzkyGolay filter(window);
    double gain = 0;  // variance of the output for independent noise of variance 1
    for (const float weight : filter.weights()) gain += static_cast<double>(weight * weight);
    EXPECT_LT(gain, before);
    before = gain;
  }
}

TEST(SavitzkyGolay, TakesAnEvenWindowForTheNextOddOne) {
  EXPECT_EQ(SavitzkyGolay(4).reach(), SavitzkyGolay(5).reach());
  EXPECT_EQ(SavitzkyGolay(14).weights().size(), 15U);
}

}  // namespace
}  // namespace terracut::baselines
