// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stage/segmentation_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace terracut::stage {
namespace {

TEST(SegmentationReport, CountsHeightsBelowALimitAndNoneThatIsNotKnown) {
  std::vector<float> height_m(101, -0.5F);
  height_m.insert(height_m.end(), {-1.0F, -1.5F, NAN, 2.0F, -7.0F});
  EXPECT_EQ(count_below(height_m, -1.0F), 2U);
  EXPECT_EQ(count_below(height_m, 0.0F), 104U);
  EXPECT_EQ(count_below({}, 0.0F), 0U);
}

}  // namespace
}  // namespace terracut::stage
