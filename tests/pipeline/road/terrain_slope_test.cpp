// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/road/terrain_slope.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/support/synthetic_frame.hpp"

namespace terracut::road {
namespace {

struct SlopeOfAFrame : testing::Test {
  static constexpr frame::ImageShape kShape{64, 1000};

  /// Fits a world of ground whose height is a function of the place, seen from right above it;
  /// there is none where that is NaN.
  void fit(const std::function<float(float x, float y)>& height) {
    image.clear();
    const mount::RingProfile profile = test::even_profile();
    test::cast_frame(profile, test::flat_ground(), image);
    frame::RangeImage raised(kShape, 0, memory);
    for (int row = 0; row < kShape.rows; ++row) {
      for (int column = 0; column < kShape.columns; ++column) {
        const auto cell = static_cast<std::size_t>(row * kShape.stride() + column);
        planes.label[cell] = frame::Label::kNone;
        planes.height_m[cell] = NAN;
        if (!image.has_return(cell)) continue;
        const float x = image.x_m()[cell], y = image.y_m()[cell];
        if (std::isnan(height(x, y))) continue;
        raised.place(row, column, {x, y, height(x, y), image.ground_range_m()[cell], 0});
        planes.label[cell] = frame::Label::kGround;
        planes.height_m[cell] = 0;
      }
    }
    ground.collect(raised, planes);
    slope.fit(ground);
  }

  memory::FixedMemory memory;
  frame::RangeImage image{kShape, 0, memory};
  stage::CellPlanes planes{kShape, memory};
  GroundPatches ground{{}, kShape, memory};
  TerrainSlope slope{{.square_m = 10}, ground.x_m().size(), memory};
};

TEST_F(SlopeOfAFrame, IsThatOfAPlane) {
  fit([](float x, float y) { return 0.1F * x - 0.05F * y; });
  for (const float x : {-25.0F, 0.0F, 12.0F, 30.0F}) {
    EXPECT_NEAR(slope.at(x, 3).along_x, 0.1F, 0.015F) << x;
    EXPECT_NEAR(slope.at(x, 3).along_y, -0.05F, 0.015F) << x;
  }
  EXPECT_NEAR(slope.at(10, 0).rise_m(2, 2), 0.1F, 0.03F);
}

TEST_F(SlopeOfAFrame, IsThatOfALongStrip) {
  // 12 m wide: what is known across it counts for less than what is along it, but not for nothing.
  for (const bool is_across : {false, true}) {
    fit([is_across](float x, float y) {
      return std::fabs(is_across ? x : y) < 6 ? 0.1F * x - 0.05F * y : NAN;
    });
    EXPECT_NEAR(slope.at(0, 0).along_x, 0.1F, 0.03F) << is_across;
    EXPECT_NEAR(slope.at(0, 0).along_y, -0.05F, 0.02F) << is_across;
  }
}

TEST_F(SlopeOfAFrame, IsThatOfAStripThatRunsObliquely) {
  fit([](float x, float y) { return std::fabs(x - y) < 6 ? 0.1F * x - 0.05F * y : NAN; });
  const auto& found = slope.at(0, 0);
  EXPECT_NEAR(found.along_x + found.along_y, 0.05F, 0.02F) << "along the strip";
}

TEST_F(SlopeOfAFrame, IsKnownByPatchAsByPlace) {
  fit([](float x, float y) { return x > 0 ? 0.1F * x : 0.02F * y; });
  for (std::size_t i = 0; i < ground.x_m().size(); ++i) {
    const auto& by_place = slope.at(ground.x_m()[i], ground.y_m()[i]);
    ASSERT_EQ(slope.at_patch(i).along_x, by_place.along_x) << i;
    ASSERT_EQ(slope.at_patch(i).along_y, by_place.along_y) << i;
  }
}

TEST_F(SlopeOfAFrame, FollowsAHillThatBeginsAhead) {
  fit([](float x, float) { return x > 15 ? 0.15F * (x - 15) : 0.0F; });
  EXPECT_NEAR(slope.at(-20, 0).along_x, 0, 0.01F);
  EXPECT_NEAR(slope.at(35, 0).along_x, 0.15F, 0.02F);
}

TEST_F(SlopeOfAFrame, DoesNotListenToRoughGround) {
  fit([](float x, float y) {
    // Grass: steep, and up and down by more than a road is.
    return y > 4 ? 0.4F * (y - 4) + 0.03F * (std::sin(97 * y) + std::sin(89 * x)) : 0.0F;
  });
  EXPECT_NEAR(slope.at(5, 0).along_y, 0, 0.05F);
}

TEST_F(SlopeOfAFrame, IsLevelWhereNothingIsSeen) {
  fit([](float x, float) { return 0.1F * x; });
  image.clear();
  for (frame::Label& label : planes.label) label = frame::Label::kNone;
  for (float& height : planes.height_m) height = NAN;
  ground.collect(image, planes);
  slope.fit(ground);
  EXPECT_EQ(slope.at(5, 0).along_x, 0);
}

TEST_F(SlopeOfAFrame, IsKnownEverywhere) {
  fit([](float x, float) { return 0.1F * x; });
  for (const float far_m : {-1e9F, -100.0F, 100.0F, 1e9F, INFINITY, -INFINITY}) {
    EXPECT_TRUE(std::isfinite(slope.at(far_m, far_m).along_x)) << far_m;
  }
  EXPECT_TRUE(std::isfinite(slope.at(NAN, NAN).along_x));
}

}  // namespace
}  // namespace terracut::road
