// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/hazards/spots.hpp"

#include <gtest/gtest.h>

#include "flat_scene.hpp"
#include "tools/research/hazards/hazard_kind.hpp"

namespace terracut::hazards {
namespace {

Hazard made(std::string_view word) {
  world::Random random(1);
  for (const HazardKind& kind : hazard_kinds()) {
    if (kind.word == word) return kind.make(random);
  }
  throw std::runtime_error("no such hazard");
}

TEST(Spots, LieOnTheGroundThatIsAskedForAndInItsBin) {
  const FlatScene scene;
  const LabelledFrame frame = scene.labelled();
  const Spots spots(frame);
  EXPECT_TRUE(spots.has_ground());
  world::Random random(3);
  for (const GroundKind ground : kGroundKinds) {
    for (std::size_t bin = 0; bin < kRangeBins.size(); ++bin) {
      const auto spot = spots.draw(made("box_30cm"), ground, bin, random);
      ASSERT_TRUE(spot) << to_string(ground) << " " << bin;
      const Eigen::Vector3d at = spot->translation();
      EXPECT_GE(at.head<2>().norm(), kRangeBins[bin].from_m);
      EXPECT_LT(at.head<2>().norm(), kRangeBins[bin].to_m);
      const double aside_m = std::abs(at.y());
      EXPECT_EQ(ground, aside_m < 4   ? GroundKind::kRoad
                        : aside_m < 8 ? GroundKind::kSidewalk
                                      : GroundKind::kGrass);
      EXPECT_NEAR(at.z(), 0, 1e-3);
      EXPECT_NEAR(spot->linear()(2, 2), 1, 1e-3) << "upright";
    }
  }
}

TEST(Spots, AreNotWhereSomethingElseStands) {
  const FlatScene scene(8);  // a car 8 m away, across the road
  const LabelledFrame frame = scene.labelled();
  const Spots spots(frame);
  for (std::uint64_t key = 0; key < 50; ++key) {
    world::Random random(key);
    const auto spot = spots.draw(made("lying_person"), GroundKind::kRoad, 0, random);
    ASSERT_TRUE(spot);
    const Eigen::Vector3d car = spot->inverse() * Eigen::Vector3d(8, spot->translation().y(), 0);
    EXPECT_TRUE(std::abs(car.x()) > 0.85 || std::abs(car.y()) > 0.22) << car.transpose();
  }
}

TEST(Spots, AreNoneWithoutThatGround) {
  FlatScene scene;
  std::ranges::replace(scene.truth, 48U, 40U);
  const LabelledFrame frame = scene.labelled();
  world::Random random(1);
  EXPECT_FALSE(Spots(frame).draw(made("child"), GroundKind::kSidewalk, 1, random));
  std::ranges::fill(scene.truth, 50U);
  EXPECT_FALSE(Spots(scene.labelled()).has_ground());
}

TEST(Spots, OfATailLiftAreSixToEightMetresAwayAndFaceTheSensor) {
  const FlatScene scene;
  const LabelledFrame frame = scene.labelled();
  const Spots spots(frame);
  for (std::uint64_t key = 0; key < 20; ++key) {
    world::Random random(key);
    const auto spot = spots.draw(made("tail_lift"), GroundKind::kRoad, 0, random);
    ASSERT_TRUE(spot);
    const Eigen::Vector2d at = spot->translation().head<2>();
    EXPECT_GE(at.norm(), 6);
    EXPECT_LT(at.norm(), 8);
    EXPECT_GT(spot->linear().col(0).head<2>().dot(at.normalized()), std::cos(0.27));
    EXPECT_FALSE(spots.draw(made("tail_lift"), GroundKind::kRoad, 1, random));
  }
}

}  // namespace
}  // namespace terracut::hazards
