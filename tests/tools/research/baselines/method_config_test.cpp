// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/baselines/method_config.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

#include "tests/support/allocation_counter.hpp"
#include "tests/support/box_scene.hpp"

namespace terracut::baselines {
namespace {

/// What holds for every method, whatever it thinks of the ground.
struct EveryMethod : testing::TestWithParam<MethodName>, test::BoxScene {
  static MethodConfig config() {
    MethodConfig named = method_named(GetParam().name).value();
    named.zhang.height_labels = 32;  // what is tested here does not need the whole cost
    named.zhang.iterations = 8;
    return named;
  }
  std::unique_ptr<ground::FrameMethod> method = maker_of(config())(
      {.profile = profile, .shape = kShape, .return_capacity = image.return_capacity()}, memory);

  static test::BeamCast street() {
    return test::ground_with_boxes({{9, 13, -1, 1, 0, 1.5}, {15, 16, -30, -8, 0, 4}});
  }
};

TEST_P(EveryMethod, LabelsEveryReturnThoseOfTakenCellsIncluded) {
  cast(street());
  for (int column = 0; column < 500; ++column) {
    const float x = 20 + 0.01F * static_cast<float>(column);
    ASSERT_TRUE(image.place(20, column, {x, 0, column % 2 == 0 ? 0.0F : 2.5F, x, 0}));
  }
  const stage::SegmentationReport report = method->segment(image);
  const auto labels = method->labels();
  EXPECT_EQ(labels.size(), image.returns());
  EXPECT_EQ(report.returns, image.returns());
  EXPECT_EQ(std::count(labels.begin(), labels.end(), frame::Label::kNone), 0);
  EXPECT_EQ(std::count_if(labels.begin(), labels.end(), frame::is_ground), report.ground);
  EXPECT_EQ(report.ground + report.obstacles, report.returns);
  EXPECT_GT(report.ground, report.returns / 2);
  EXPECT_GT(report.obstacles, 500U);
}

TEST_P(EveryMethod, SeesTheGroundAndTheHouse) {
  cast(street());
  (void)method->segment(image);
  const auto house = [](float x, float y, float z) {
    return x > 14.9F && y < -8.5F && y > -20 && z > 0.6F;
  };
  EXPECT_GT(share(method->labels(), frame::Label::kObstacle, house), 0.99);
  const auto road = [](float x, float, float z) { return x < 7 && z < 0.01F; };
  const double ground = std::max(share(method->labels(), frame::Label::kGround, road), 0.0) +
                        std::max(share(method->labels(), frame::Label::kOtherGround, road), 0.0);
  EXPECT_GT(ground, 0.99);
}

TEST_P(EveryMethod, AllocatesNothingPerFrame) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer brings its own allocator";
  cast(street());
  (void)method->segment(image);
  const std::uint64_t before = test::allocations_of_this_thread();
  for (int frame = 0; frame < 2; ++frame) (void)method->segment(image);
  EXPECT_EQ(test::allocations_of_this_thread() - before, 0U);
}

TEST_P(EveryMethod, GivesTheSameLabelsWhateverCameBefore) {
  cast(street());
  (void)method->segment(image);
  const std::vector<frame::Label> first(method->labels().begin(), method->labels().end());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> range_m(0.5, 119);
  cast([&](double, double) { return range_m(random); });
  (void)method->segment(image);
  EXPECT_EQ(method->labels().size(), image.returns());
  cast(street());
  (void)method->segment(image);
  EXPECT_TRUE(
      std::equal(first.begin(), first.end(), method->labels().begin(), method->labels().end()));
}

TEST_P(EveryMethod, HasNoLabelsForAnEmptyFrame) {
  cast([](double, double) { return -1.0; });
  EXPECT_EQ(method->segment(image).returns, 0U);
  EXPECT_TRUE(method->labels().empty());
}

TEST_P(EveryMethod, ReportsItsLastStageToTheObserver) {
  struct Recorder : stage::StageObserver {
    void stage_done(stage::Stage stage) noexcept override {
      if (std::ranges::find(seen, stage) == seen.end()) seen.push_back(stage);
    }
    std::vector<stage::Stage> seen;  // the first ones may be done in parts
  } recorder;
  recorder.seen.reserve(8);
  cast(street());
  (void)method->segment(image, {}, &recorder);
  ASSERT_FALSE(recorder.seen.empty());
  EXPECT_EQ(recorder.seen.back(), stage::Stage::kLabels);
  EXPECT_TRUE(std::is_sorted(recorder.seen.begin(), recorder.seen.end()));
}

TEST_P(EveryMethod, KeepsWhereItsCellsAreLabelled) {
  cast(street());
  (void)method->segment(image);
  const stage::CellPlanes& planes = method->planes();
  for (std::size_t cell = 0; cell < kShape.cells(); ++cell) {
    ASSERT_EQ(planes.label[cell] != frame::Label::kNone, image.has_return(cell)) << cell;
    ASSERT_EQ(std::isnan(planes.height_m[cell]), !image.has_return(cell)) << cell;
  }
}

INSTANTIATE_TEST_SUITE_P(Named, EveryMethod, testing::ValuesIn(method_names()),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(MethodNames, AreUniqueAndSaidToBeWhatTheyAre) {
  std::set<std::string_view> names, abouts;
  for (const MethodName& method : method_names()) {
    EXPECT_TRUE(names.insert(method.name).second);
    EXPECT_TRUE(abouts.insert(method.about).second);
    EXPECT_TRUE(method_named(method.name).has_value());
  }
  EXPECT_EQ(method_named("zhang")->kind, MethodKind::kZhang);
  EXPECT_EQ(method_named("ring_map")->segmenter.last_stage, stage::Stage::kElevationMap);
}

TEST(MethodNames, AnUnknownOneIsRefusedWithThoseThereAre) {
  const auto refused = method_named("zang");
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("'zang'"), std::string::npos);
  EXPECT_NE(refused.error().message.find("zhang"), std::string::npos);
}

}  // namespace
}  // namespace terracut::baselines
