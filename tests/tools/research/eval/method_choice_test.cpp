// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/eval/method_choice.hpp"

#include <gmock/gmock.h>

#include <vector>

namespace terracut::eval {
namespace {

using testing::HasSubstr;

TEST(MethodVariant, IsTheMethodWithOtherParametersUnderAName) {
  const auto variant = method_variant("no_bands=paper,grid.max_band_m=3,adjacent.rule=slope", {});
  ASSERT_TRUE(variant) << variant.error().message;
  EXPECT_EQ(variant->name, "no_bands");
  EXPECT_EQ(variant->base, "paper");
  const auto paper = *method_named("paper");
  EXPECT_NE(paper.config.segmenter.elevation_map.grid.max_band_m, 3);
  EXPECT_EQ(variant->config.segmenter.elevation_map.grid.max_band_m, 3);
  EXPECT_EQ(variant->config.segmenter.adjacent_points.rule, elevation::AdjacentRule::kSlope);
  EXPECT_EQ(variant->config.segmenter.seeds.ground_share,
            paper.config.segmenter.seeds.ground_share);
}

TEST(MethodVariant, MayChangeNothing) {
  const auto variant = method_variant("again=terracut", {});
  ASSERT_TRUE(variant) << variant.error().message;
  EXPECT_EQ(variant->about, method_named("terracut")->about);
}

TEST(MethodVariant, ItsOwnSettingsWinOverThoseOfAll) {
  const std::vector<std::string> of_all{"grid.max_band_m=7", "grid.min_band_m=0.3"};
  const auto variant = method_variant("a=terracut,grid.max_band_m=3", of_all);
  ASSERT_TRUE(variant) << variant.error().message;
  EXPECT_EQ(variant->config.segmenter.elevation_map.grid.max_band_m, 3);
  EXPECT_FLOAT_EQ(variant->config.segmenter.elevation_map.grid.min_band_m, 0.3F);
}

TEST(MethodVariant, OfABaselineTakesItsParametersAlone) {
  EXPECT_TRUE(method_variant("fine=pfaff,pfaff.cell_m=0.25", {}));
  for (const char* const text :
       {"fine=pfaff,grid.max_band_m=3", "fine=terracut,pfaff.cell_m=0.25"}) {
    const auto variant = method_variant(text, {});
    ASSERT_FALSE(variant) << text;
    EXPECT_EQ(variant.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(variant.error().message, HasSubstr("of another method"));
  }
}

TEST(MethodVariant, IsRefusedWithItsTextAndTheReason) {
  const std::pair<const char*, const char*> kRefused[] = {
      {"", "NAME=METHOD"},
      {"a", "NAME=METHOD"},
      {"=terracut", "name"},
      {"../a=terracut", "name"},
      {"paper=terracut", "that of a method"},
      {"a=nothing", "nothing"},
      {"a=terracut,grid.max_band_m", "KEY=VALUE"},
      {"a=terracut,grid.no=1", "grid.no"},
      {"a=terracut,grid.max_band_m=-1", "grid.max_band_m"},
  };
  for (const auto& [text, why] : kRefused) {
    const auto variant = method_variant(text, {});
    ASSERT_FALSE(variant) << text;
    EXPECT_EQ(variant.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(variant.error().message, HasSubstr(text));
    EXPECT_THAT(variant.error().message, HasSubstr(why));
  }
}

}  // namespace
}  // namespace terracut::eval
