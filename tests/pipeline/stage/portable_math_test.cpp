// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stage/portable_math.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace terracut::stage {
namespace {

TEST(PortableMath, LogAgreesWithTheStandardLibrary) {
  for (double x = 1e-6; x < 1e9; x *= 1.013) {
    EXPECT_NEAR(portable_log(x), std::log(x), 1e-9 * std::fmax(1.0, std::fabs(std::log(x)))) << x;
  }
  EXPECT_EQ(portable_log(1.0), 0.0);
}

TEST(PortableMath, NegativeExpAgreesWithTheStandardLibrary) {
  const auto negative_exp = [exp = NegativeExp()](float t) {
    return exp(FourFloats{t, 1, t, NAN})[2];
  };
  for (float t = 0; t < 15.9F; t += 0.0037F) {
    EXPECT_NEAR(negative_exp(t), std::exp(-t), 4e-5F) << t;
  }
}

TEST(PortableMath, NegativeExpIsDefinedForEveryFloat) {
  const auto negative_exp = [exp = NegativeExp()](float t) {
    return exp(FourFloats{t, 1, t, NAN})[2];
  };
  EXPECT_EQ(negative_exp(0.0F), 1.0F);
  EXPECT_EQ(negative_exp(-3.0F), 1.0F);
  EXPECT_EQ(negative_exp(16.0F), 0.0F);
  EXPECT_EQ(negative_exp(INFINITY), 0.0F);
  EXPECT_EQ(negative_exp(NAN), 0.0F);
  EXPECT_GE(negative_exp(15.9999F), 0.0F);
}

}  // namespace
}  // namespace terracut::stage
