// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <algorithm>
#include <array>

#include "roadside.hpp"
#include "scene_layout.hpp"
#include "scenes.hpp"
#include "vehicles.hpp"

namespace terracut::scenes {
namespace {

constexpr double kMedian_m = 1.4;  // Half the width of the median strip.
constexpr double kLane_m = 3.75;
constexpr double kCarriageway_m = 0.8 + 2 * kLane_m + 2.5;
constexpr double kVerge_m = 1.2;
constexpr double kFastLane_d_m = kMedian_m + 0.8 + kLane_m / 2;
constexpr double kSlowLane_d_m = kFastLane_d_m + kLane_m;
constexpr double kRail_d_m = kMedian_m + kCarriageway_m + kVerge_m - 0.4;
constexpr double kBank_d_m = kRail_d_m + 12.0;
constexpr double kSpeed_mps = 27.0;
constexpr double kTruck_mps = 24.0;

world::RoadSide road_side(double bank_slope, double bank_m) {
  world::RoadSide side;
  side.strips.push_back(
      {kMedian_m, 0, 0, 0.01, world::Truth::kOtherGround, world::Material::kGravel});
  side.strips.push_back(
      {kCarriageway_m, 0, -0.025, 0.006, world::Truth::kRoad, world::Material::kAsphalt});
  side.strips.push_back(
      {kVerge_m, 0, -0.04, 0.02, world::Truth::kOtherGround, world::Material::kGravel});
  side.strips.push_back({2.5, 0, -0.12, 0.04, world::Truth::kTerrain, world::Material::kGrass});
  side.strips.push_back(
      {bank_m, 0, bank_slope, 0.06, world::Truth::kTerrain, world::Material::kGrass});
  side.strips.push_back({1, 0, 0.01, 0.15, world::Truth::kTerrain, world::Material::kSoil});
  return side;
}

void add_carriageway(SceneLayout& layout, double sign, double ego_mps, std::uint64_t row) {
  const double fast_mps = sign < 0 ? ego_mps : -30.0;
  const double slow_mps = sign < 0 ? std::min(kTruck_mps, ego_mps) : -kTruck_mps;
  const double heading_rad = sign < 0 ? 0 : kAgainst_rad;
  layout.row(row, 38, fast_mps, [&](world::Random& random, double s_m) {
    if ((sign < 0 && std::abs(s_m) < 20) || random.chance(0.35)) return;
    const double at_m = s_m + random.uniform(-6, 6);
    layout.add(make_car(random), {at_m, sign * kFastLane_d_m}, heading_rad, fast_mps);
  });
  layout.row(row + 1, 30, slow_mps, [&](world::Random& random, double s_m) {
    if (random.chance(0.3)) return;
    world::SceneObject vehicle = random.chance(0.55) ? make_truck(random) : make_car(random);
    layout.add(std::move(vehicle), {s_m + random.uniform(-4, 4), sign * kSlowLane_d_m}, heading_rad,
               slow_mps);
  });
}

void add_roadside(SceneLayout& layout, double sign, std::uint64_t row) {
  layout.row(row, 8, 0, [&](world::Random&, double s_m) {
    layout.add_along(make_guard_rail(8), {s_m, sign * kRail_d_m}, 8);
  });
  layout.row(row + 1, 9, 0, [&](world::Random& random, double s_m) {
    if (random.chance(0.4)) return;
    const world::RoadPoint place{s_m + random.uniform(-4, 4),
                                 sign * (kBank_d_m + random.uniform(0, 15))};
    layout.add(random.chance(0.5) ? make_tree(random) : make_bush(random), place);
  });
  layout.row(row + 2, 50, 0, [&](world::Random& random, double s_m) {
    layout.add(make_sign_post(random), {s_m, sign * (kRail_d_m + 0.6)},
               sign < 0 ? 0 : kAgainst_rad);
  });
}

}  // namespace

Scene make_highway_scene(const SceneExtent& extent) {
  world::Random random(world::mix_keys(extent.seed, 1));
  world::Road road;
  road.bend_m = random.uniform(0, 12);
  road.bend_length_m = 900;
  const double grade = random.chance(0.5) ? 0.03 : -0.03;
  const std::array<world::GradeProfile::Knot, 4> knots = {
      {{-100, grade}, {120, grade}, {320, -grade}, {520, -grade}}};
  road.grade = world::GradeProfile(knots);
  const double up = random.uniform(0.2, 0.35);
  const double down = -random.uniform(0.2, 0.35);
  road.left = road_side(up, random.uniform(5, 9));
  road.right = road_side(down, random.uniform(4, 7));
  road.lane_mark_d_m = kFastLane_d_m + kLane_m / 2;

  Scene scene{world::Terrain(road, world::mix_keys(extent.seed, 2)),
              {},
              -kFastLane_d_m,
              extent.speed_mps < 0 ? kSpeed_mps : extent.speed_mps};
  SceneLayout layout(scene, extent);
  const bool concrete = random.chance(0.5);
  layout.row(10, 6, 0, [&](world::Random&, double s_m) {
    layout.add_along(concrete ? make_concrete_barrier(6) : make_guard_rail(6), {s_m, 0}, 6);
  });
  layout.row(11, 170, 0, [&](world::Random& slot, double s_m) {
    layout.add(make_overpass(2 * kRail_d_m + 4), {s_m + 60 + slot.uniform(-20, 20), 0});
  });
  add_carriageway(layout, -1, scene.ego_speed_mps, 20);
  add_carriageway(layout, 1, scene.ego_speed_mps, 30);
  add_roadside(layout, -1, 40);
  add_roadside(layout, 1, 50);
  return scene;
}

}  // namespace terracut::scenes
