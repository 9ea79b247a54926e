// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <array>

#include "people.hpp"
#include "roadside.hpp"
#include "scene_layout.hpp"
#include "scenes.hpp"
#include "vehicles.hpp"

namespace terracut::scenes {
namespace {

constexpr double kHalfRoad_m = 2.9;
constexpr double kVerge_m = 0.8;
constexpr double kDitch_m = 1.6;  // Width of each side of the ditch.
constexpr double kDitch_d_m = kHalfRoad_m + kVerge_m + kDitch_m;
constexpr double kField_d_m = kDitch_d_m + kDitch_m;
constexpr double kLane_d_m = 1.4;
constexpr double kSpeed_mps = 12.0;

world::RoadSide road_side(double bank_slope, double bank_m, double roughness_m) {
  world::RoadSide side;
  side.strips.push_back(
      {kHalfRoad_m, 0, -0.028, 0.015, world::Truth::kRoad, world::Material::kAsphalt});
  side.strips.push_back(
      {kVerge_m, 0, -0.05, 0.03, world::Truth::kOtherGround, world::Material::kGravel});
  side.strips.push_back({kDitch_m, 0, -0.3, 0.04, world::Truth::kTerrain, world::Material::kGrass});
  side.strips.push_back({kDitch_m, 0, 0.3, 0.05, world::Truth::kTerrain, world::Material::kGrass});
  side.strips.push_back(
      {bank_m, 0, bank_slope, 0.08, world::Truth::kTerrain, world::Material::kGrass});
  side.strips.push_back({1, 0, 0.01, roughness_m, world::Truth::kTerrain, world::Material::kSoil});
  return side;
}

void add_roadside(SceneLayout& layout, double sign, std::uint64_t row) {
  // Hedges and fences extend over some length, so they are chosen per 40 m and placed in pieces.
  layout.row(row, 40, 0, [&](world::Random& random, double s_m) {
    const double kind = random.unit();
    const double d_m = sign * (kField_d_m + random.uniform(0.3, 1.5));
    const double high_m = random.uniform(0.9, 2.2);
    for (int piece = 0; piece < 7 && kind < 0.75; ++piece) {
      const world::RoadPoint place{s_m + 5.0 * piece, d_m};
      layout.add_along(kind < 0.45 ? make_hedge(5, high_m) : make_mesh_fence(5), place, 5);
    }
  });
  layout.row(row + 1, 7, 0, [&](world::Random& random, double s_m) {
    const world::RoadPoint place{s_m + random.uniform(-3, 3),
                                 sign * (kField_d_m + random.uniform(2.5, 30))};
    if (random.chance(0.45)) {
      layout.add(make_bush(random), place);
    } else if (random.chance(0.5)) {
      layout.add(make_tree(random), place);
    }
  });
  layout.row(row + 2, 35, 0, [&](world::Random& random, double s_m) {
    const world::RoadPoint place{s_m, sign * (kHalfRoad_m + kVerge_m + 0.3)};
    if (random.chance(0.5)) {
      layout.add(make_sign_post(random), place, sign < 0 ? 0 : kAgainst_rad);
    } else {
      layout.add(make_bollard(), place);
    }
  });
}

}  // namespace

Scene make_rural_scene(const SceneExtent& extent) {
  world::Random random(world::mix_keys(extent.seed, 1));
  world::Road road;
  road.bend_m = random.uniform(3, 7);
  road.bend_length_m = random.uniform(280, 380);
  const double grade = random.uniform(0.03, 0.06);
  const std::array<world::GradeProfile::Knot, 5> knots = {
      {{-80, -grade}, {0, grade}, {80, -grade}, {170, grade}, {260, -grade}}};
  road.grade = world::GradeProfile(knots);
  const double up = random.uniform(0.25, 0.4);
  const double nearly_level = random.uniform(-0.1, 0.05);
  road.left = road_side(up, random.uniform(3, 6), 0.15);
  road.right = road_side(nearly_level, random.uniform(3, 6), 0.12);

  Scene scene{world::Terrain(road, world::mix_keys(extent.seed, 2)),
              {},
              -kLane_d_m,
              extent.speed_mps < 0 ? kSpeed_mps : extent.speed_mps};
  SceneLayout layout(scene, extent);
  add_roadside(layout, 1, 10);
  add_roadside(layout, -1, 20);
  layout.row(30, 70, -14, [&](world::Random& slot, double s_m) {
    layout.add(slot.chance(0.25) ? make_truck(slot) : make_car(slot), {s_m + 40, kLane_d_m},
               kAgainst_rad, -14);
  });
  layout.row(31, 60, -4.5, [&](world::Random& slot, double s_m) {
    const double at_m = s_m + slot.uniform(-10, 10);
    layout.add(make_cyclist(slot), {at_m, kHalfRoad_m + 0.1}, kAgainst_rad, -4.5);
  });
  layout.row(32, 50, 1.2, [&](world::Random& slot, double s_m) {
    const double at_m = s_m + slot.uniform(-10, 10);
    layout.add(make_pedestrian(slot), {at_m, -(kHalfRoad_m + 0.3)}, 0, 1.2);
  });
  return scene;
}

}  // namespace terracut::scenes
