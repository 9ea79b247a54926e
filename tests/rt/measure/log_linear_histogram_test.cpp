// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/measure/log_linear_histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace terracut::measure {
namespace {

/// The exact percentile: the value of rank ceil(percent / 100 * count).
std::int64_t exact_percentile(std::vector<std::int64_t> values, double percent) {
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(percent / 100.0 * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

void expect_two_digits(const std::vector<std::int64_t>& values) {
  LogLinearHistogram histogram;
  for (const std::int64_t value : values) histogram.record(value);
  for (const double percent : {0.0, 1.0, 10.0, 50.0, 90.0, 99.0, 99.9, 99.99, 100.0}) {
    const std::int64_t exact = exact_percentile(values, percent);
    const std::int64_t shown = histogram.percentile_ns(percent);
    EXPECT_GE(shown, exact) << "p" << percent;
    EXPECT_LE(shown, exact + exact / 128) << "p" << percent;
  }
  EXPECT_EQ(histogram.count(), values.size());
  EXPECT_EQ(histogram.max_ns(), *std::max_element(values.begin(), values.end()));
  EXPECT_EQ(histogram.min_ns(), *std::min_element(values.begin(), values.end()));
}

TEST(LogLinearHistogram, SaysNothingOfNothing) {
  const LogLinearHistogram histogram;
  EXPECT_EQ(histogram.count(), 0U);
  EXPECT_EQ(histogram.percentile_ns(99), 0);
  EXPECT_EQ(histogram.min_ns(), 0);
  EXPECT_EQ(histogram.max_ns(), 0);
  EXPECT_EQ(histogram.mean_ns(), 0);
}

TEST(LogLinearHistogram, IsExactBelow256NanosecondsAndWithinA128thBehind) {
  for (std::int64_t value = 0; value < 4096; ++value) {
    LogLinearHistogram histogram;
    histogram.record(value);
    histogram.record(LogLinearHistogram::kMax_ns);
    EXPECT_GE(histogram.percentile_ns(50), value);
    EXPECT_LE(histogram.percentile_ns(50), value < 256 ? value : value + value / 128);
  }
}

TEST(LogLinearHistogram, KeepsTwoDigitsOfUniformTimes) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::int64_t> any(0, 20'000'000);
  std::vector<std::int64_t> values(19'937);  // no percentile is a whole number of them
  for (auto& value : values) value = any(random);
  expect_two_digits(values);
}

TEST(LogLinearHistogram, KeepsTwoDigitsOverTwelveDecades) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(0.0, 40.0);
  std::vector<std::int64_t> values(19'937);  // no percentile is a whole number of them
  for (auto& value : values) value = static_cast<std::int64_t>(std::exp2(exponent(random))) - 1;
  expect_two_digits(values);
}

TEST(LogLinearHistogram, IsRightOnBothSidesOfEveryPowerOfTwo) {
  for (int bit = 1; bit < 40; ++bit) {
    const std::int64_t power = std::int64_t{1} << bit;
    for (const std::int64_t value : {power - 1, power, power + 1}) {
      LogLinearHistogram histogram;
      histogram.record(value);
      histogram.record(LogLinearHistogram::kMax_ns);
      EXPECT_GE(histogram.percentile_ns(50), value);
      EXPECT_LE(histogram.percentile_ns(50), value + value / 128);
    }
  }
}

TEST(LogLinearHistogram, CountsValuesOutsideItsRangeAtTheEnds) {
  LogLinearHistogram histogram;
  histogram.record(-5);
  histogram.record(INT64_MAX);
  EXPECT_EQ(histogram.count(), 2U);
  EXPECT_EQ(histogram.percentile_ns(50), 0);
  EXPECT_EQ(histogram.max_ns(), INT64_MAX);
}

TEST(LogLinearHistogram, NeverCountsASlowerValueAsNotAboveALimit) {
  LogLinearHistogram histogram;
  constexpr std::int64_t kLast = 1'000'000;
  for (std::int64_t value = 1; value <= kLast; ++value) histogram.record(value);
  EXPECT_EQ(histogram.count_not_above(-1), 0U);
  for (const std::int64_t limit : {1, 200, 255, 256, 5'000, 65'536, 700'001, 999'999}) {
    const auto counted = static_cast<std::int64_t>(histogram.count_not_above(limit));
    EXPECT_LE(counted, limit);
    EXPECT_GE(counted, limit - limit / 128 - 1);
  }
  EXPECT_EQ(histogram.count_not_above(2 * kLast), histogram.count());
}

}  // namespace
}  // namespace terracut::measure
