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

constexpr double kSlope = 0.15;
constexpr double kHalfRoad_m = 3.4;
constexpr double kParking_m = 2.2;
constexpr double kPavement_m = 1.8;
constexpr double kPavementEnd_m = kHalfRoad_m + kParking_m + kPavement_m;
constexpr double kLane_d_m = 1.6;
constexpr double kSpeed_mps = 8.0;

}  // namespace

Scene make_hill_scene(const SceneExtent& extent) {
  world::Random random(world::mix_keys(extent.seed, 1));
  world::Road road;
  road.bend_m = random.uniform(0, 4);
  road.bend_length_m = 400;
  const std::array<world::GradeProfile::Knot, 6> knots = {
      {{-30, 0}, {15, kSlope}, {150, kSlope}, {200, 0}, {250, -kSlope}, {400, -kSlope}}};
  road.grade = world::GradeProfile(knots);
  const double kerb_m = random.uniform(0.08, 0.16);
  // The hill rises on the left, with parked cars, a pavement and a bank. It falls on the right,
  // behind a guard rail.
  road.left.strips = {
      {kHalfRoad_m, 0, -0.02, 0.01, world::Truth::kRoad, world::Material::kAsphalt},
      {kParking_m, 0, -0.02, 0.01, world::Truth::kParking, world::Material::kPaving},
      {kPavement_m, kerb_m, 0.02, 0.01, world::Truth::kSidewalk, world::Material::kPaving},
      {12, 0, random.uniform(0.2, 0.3), 0.08, world::Truth::kTerrain, world::Material::kGrass},
      {1, 0, 0.08, 0.12, world::Truth::kTerrain, world::Material::kGrass},
  };
  road.right.strips = {
      {kHalfRoad_m, 0, -0.02, 0.01, world::Truth::kRoad, world::Material::kAsphalt},
      {1.2, 0, -0.04, 0.03, world::Truth::kOtherGround, world::Material::kGravel},
      {15, 0, -random.uniform(0.15, 0.25), 0.08, world::Truth::kTerrain, world::Material::kGrass},
      {1, 0, -0.03, 0.12, world::Truth::kTerrain, world::Material::kGrass},
  };

  Scene scene{world::Terrain(road, world::mix_keys(extent.seed, 2)),
              {},
              -kLane_d_m,
              extent.speed_mps < 0 ? kSpeed_mps : extent.speed_mps};
  SceneLayout layout(scene, extent);
  layout.row(10, 6, 0, [&](world::Random& slot, double s_m) {
    if (slot.chance(0.4)) return;
    layout.add(make_car(slot), {s_m, kHalfRoad_m + kParking_m / 2}, kAgainst_rad);
  });
  layout.row(11, 8, 0, [&](world::Random&, double s_m) {
    layout.add_along(make_guard_rail(8), {s_m, -(kHalfRoad_m + 0.9)}, 8);
  });
  layout.row(12, 14, 0, [&](world::Random& slot, double s_m) {
    if (slot.chance(0.5)) return;
    layout.add(make_pedestrian(slot), {s_m, kPavementEnd_m - 0.7}, kAgainst_rad, -1.2);
  });
  for (const double sign : {1.0, -1.0}) {
    layout.row(sign > 0 ? 13 : 14, 8, 0, [&](world::Random& slot, double s_m) {
      const double d_m = sign * (kPavementEnd_m + slot.uniform(1.5, 28));
      if (slot.chance(0.3)) return;
      layout.add(slot.chance(0.5) ? make_tree(slot) : make_bush(slot), {s_m, d_m});
    });
  }
  layout.row(15, 28, 0, [&](world::Random& slot, double s_m) {
    if (slot.chance(0.5)) return;
    layout.add(make_building(10, 8, slot.uniform(4, 7)), {s_m, kPavementEnd_m + 14});
  });
  layout.row(16, 45, -9, [&](world::Random& slot, double s_m) {
    layout.add(make_car(slot), {s_m + 25, kLane_d_m}, kAgainst_rad, -9);
  });
  layout.row(17, 40, scene.ego_speed_mps, [&](world::Random& slot, double s_m) {
    if (std::abs(s_m) < 15) return;
    layout.add(make_car(slot), {s_m, -kLane_d_m}, 0, scene.ego_speed_mps);
  });
  return scene;
}

}  // namespace terracut::scenes
