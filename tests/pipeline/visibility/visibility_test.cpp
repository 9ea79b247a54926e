// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/visibility/visibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/support/allocation_counter.hpp"
#include "tests/support/box_scene.hpp"

namespace terracut::visibility {
namespace {

using frame::Label;

/// True for beams that return nothing.
using Loses = std::function<bool(double azimuth_rad, double elevation_rad)>;

/// Labels the returns of level ground and what stands on it by their heights.
void label_by_height(const frame::RangeImage& image, stage::CellPlanes& planes) {
  for (std::size_t cell = 0; cell < planes.label.size(); ++cell) {
    planes.height_m[cell] = image.has_return(cell) ? image.z_m()[cell] : NAN;
    planes.label[cell] = !image.has_return(cell)     ? Label::kNone
                         : image.z_m()[cell] > 0.05F ? Label::kObstacle
                                                     : Label::kGround;
  }
}

/// Turns of a sensor on level ground.
struct ViewOfASensor : testing::Test, test::BoxScene {
  /// Looks at some turns of the same scene.
  Condition see(const test::BeamCast& beams, int turns) {
    cast(beams);
    label_by_height(image, planes);
    for (int i = 0; i < turns; ++i) view.look(image, planes);
    return view.worst();
  }
  static test::BeamCast without(test::BeamCast beams, Loses loses) {
    return [=](double azimuth_rad, double elevation_rad) {
      return loses(azimuth_rad, elevation_rad) ? -1 : beams(azimuth_rad, elevation_rad);
    };
  }
  static Loses nothing_between(double from_deg, double to_deg) {
    return [=](double azimuth_rad, double) {
      const double azimuth_deg = azimuth_rad * 180 / std::numbers::pi;
      return azimuth_deg >= from_deg && azimuth_deg < to_deg;
    };
  }

  stage::CellPlanes planes{kShape, memory};
  Visibility view{{}, profile, kShape, memory};
  test::BeamCast open_field = test::flat_ground();
  /// Walls 12 m ahead and to both sides, 20 m behind.
  test::BeamCast street = test::ground_with_boxes(
      {{12, 13, -60, 60, 0, 6}, {-60, 60, 12, 13, 0, 6}, {-60, 60, -13, -12, 0, 6}});
};

TEST_F(ViewOfASensor, IsLearntFirstAndThenClear) {
  EXPECT_FALSE(view.has_learnt());
  EXPECT_EQ(see(open_field, 10), Condition{});
  EXPECT_TRUE(view.has_learnt());
  EXPECT_EQ(see(open_field, 20), Condition{});
  for (const Visibility::Sector& sector : view.sectors()) {
    EXPECT_TRUE(sector.has_view);
    EXPECT_GT(sector.now.visible_m, 30);
    EXPECT_EQ(sector.now.lost, 0);
  }
}

TEST_F(ViewOfASensor, IsBlockedWhereACoveredSectorReturnsNothing) {
  see(street, 12);
  const test::BeamCast covered = without(street, nothing_between(95, 125));
  EXPECT_EQ(see(covered, 3), Condition{}) << "not yet";
  EXPECT_EQ(see(covered, 1), (Condition{State::kBlocked, Cause::kCovered}));
  EXPECT_EQ(view.troubled_sectors(), 2) << "those that are covered wholly";
  EXPECT_EQ(view.sectors()[10].condition.state, State::kBlocked);
  EXPECT_EQ(view.sectors()[10].now.visible_m, 0);
  EXPECT_EQ(view.sectors()[20].condition.state, State::kClear);
  see(covered, 300);
  EXPECT_EQ(view.worst().state, State::kBlocked) << "trouble does not become the usual view";
  EXPECT_EQ(see(street, 4), Condition{});
}

TEST_F(ViewOfASensor, IsNoTroubleWhereNothingWasEverSeen) {
  const test::BeamCast at_a_wall = without(open_field, nothing_between(90, 270));
  EXPECT_EQ(see(at_a_wall, 40), Condition{});
  EXPECT_FALSE(view.sectors()[15].has_view);
  EXPECT_TRUE(view.sectors()[0].has_view);
}

TEST_F(ViewOfASensor, StaysClearFromAFieldIntoATunnelAndOut) {
  see(open_field, 15);
  const test::BeamCast tunnel = test::ground_with_boxes(
      {{-200, 200, 4, 5, 0, 6}, {-200, 200, -5, -4, 0, 6}, {-200, 200, -5, 5, 5, 6}});
  EXPECT_EQ(see(tunnel, 20), Condition{});
  EXPECT_EQ(see(open_field, 20), Condition{});
  EXPECT_EQ(see(street, 20), Condition{});
}

TEST_F(ViewOfASensor, IsFoggyWhereNothingReturnsFromAfarAllAround) {
  see(open_field, 12);
  const test::BeamCast fog = [&](double azimuth_rad, double elevation_rad) {
    const double way_m = open_field(azimuth_rad, elevation_rad);
    return way_m > 15 ? -1 : way_m;
  };
  EXPECT_EQ(see(fog, 4), (Condition{State::kReduced, Cause::kFog}));
  EXPECT_EQ(view.troubled_sectors(), 36);
  EXPECT_LT(view.sectors()[0].now.visible_m, 16);
}

TEST_F(ViewOfASensor, IsDirtyWhereTheSameBeamsAreLostAllAround) {
  see(street, 12);
  const auto spots = [](double azimuth_rad, double elevation_rad) {
    return std::fmod(azimuth_rad * 180 / std::numbers::pi, 9.0) < 2 && elevation_rad < -0.1;
  };
  EXPECT_EQ(see(without(street, spots), 7), (Condition{State::kReduced, Cause::kDirt}));
}

TEST_F(ViewOfASensor, HasSprayWhereReturnsHangAloneInTheAir) {
  see(street, 12);
  const test::BeamCast spray = [&](double azimuth_rad, double elevation_rad) {
    const double azimuth_deg = azimuth_rad * 180 / std::numbers::pi;
    const auto column = static_cast<int>(azimuth_deg * kShape.columns / 360);
    const auto row =
        static_cast<int>(std::lround(elevation_rad * 180 / std::numbers::pi / 26 * 63));
    const bool is_droplet =
        azimuth_deg < 20 && elevation_rad > -0.15 && column % 2 == 0 && row % 2 == 0;
    return is_droplet ? 6.0 : street(azimuth_rad, elevation_rad);
  };
  EXPECT_EQ(see(spray, 4), (Condition{State::kReduced, Cause::kAirborne}));
  EXPECT_LE(view.troubled_sectors(), 3);
}

TEST_F(ViewOfASensor, HasNoSprayWherePolesStandWhoseReturnsAreOneRowApart) {
  constexpr frame::ImageShape kSparse{14, 1000};  // rows 2 degrees apart, as a VLP-16's
  profile = test::even_profile(kSparse.rows);
  frame::RangeImage sparse_image{kSparse, 1000, memory};
  stage::CellPlanes labels{kSparse, memory};
  Visibility sparse_view{{}, profile, kSparse, memory};
  const auto look = [&](const test::BeamCast& beams, int turns) {
    test::cast_frame(profile, beams, sparse_image);
    label_by_height(sparse_image, labels);
    for (int i = 0; i < turns; ++i) sparse_view.look(sparse_image, labels);
  };
  look(open_field, 12);
  std::vector<test::Box> poles;
  for (double left_m = -3; left_m <= 3; left_m += 0.75) {
    poles.push_back({18.5, 18.6, left_m, left_m + 0.1, 0, 4});
  }
  look(test::ground_with_boxes(poles), 10);
  EXPECT_EQ(sparse_view.worst(), Condition{});
}

TEST_F(ViewOfASensor, IsLearntAnewOnceForgotten) {
  see(street, 12);
  see(without(street, nothing_between(0, 40)), 5);
  view.forget();
  EXPECT_FALSE(view.has_learnt());
  EXPECT_EQ(view.worst(), Condition{});
}

TEST_F(ViewOfASensor, AllocatesNothingForATurn) {
  see(street, 12);
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer counts its own";
  const std::uint64_t before = test::allocations_of_this_thread();
  view.look(image, planes);
  EXPECT_EQ(test::allocations_of_this_thread(), before);
}

}  // namespace
}  // namespace terracut::visibility
