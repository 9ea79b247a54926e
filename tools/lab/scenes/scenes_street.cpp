// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <algorithm>
#include <array>

#include "people.hpp"
#include "roadside.hpp"
#include "scene_layout.hpp"
#include "scenes.hpp"
#include "vehicles.hpp"

namespace terracut::scenes {
namespace {

constexpr double kLane_m = 3.5;
constexpr double kParking_m = 2.2;
constexpr double kEgoLane_d_m = -1.75;
constexpr double kSpeed_mps = 8.33;
constexpr double kOncoming_mps = -9.0;
constexpr double kDroppedEvery_m = 26.0;

/// One side of the street; all widths are measured from the centre line outwards.
struct SidePlan {
  double sign = 1;  ///< +1 left, -1 right.
  bool parking = true;
  double kerb_m = 0.12;
  double pavement_m = 2.8;
  double garden_m = 3.0;

  [[nodiscard]] double kerb_d_m() const { return kLane_m + (parking ? kParking_m : 0.4); }
  [[nodiscard]] double pavement_end_m() const { return kerb_d_m() + pavement_m; }
  [[nodiscard]] double houses_m() const { return pavement_end_m() + garden_m; }
};

SidePlan plan_side(double sign, world::Random& random) {
  SidePlan plan;
  plan.sign = sign;
  plan.parking = random.chance(0.6);
  plan.kerb_m = random.uniform(0.06, 0.20);
  plan.pavement_m = random.uniform(2.2, 3.5);
  plan.garden_m = random.uniform(1.0, 5.0);
  return plan;
}

world::RoadSide road_side(const SidePlan& plan, world::Random& random) {
  world::RoadSide side;
  side.strips.push_back({.width_m = kLane_m, .slope = -0.022, .bumps_m = 0.008});
  if (plan.parking) {
    side.strips.push_back(
        {kParking_m, 0, -0.022, 0.008, world::Truth::kParking, world::Material::kPaving});
  } else {
    side.strips.push_back({0.4, 0, -0.03, 0.008, world::Truth::kRoad, world::Material::kAsphalt});
  }
  side.strips.push_back({plan.pavement_m, plan.kerb_m, 0.02, 0.008, world::Truth::kSidewalk,
                         world::Material::kPaving});
  side.strips.push_back({1, 0, 0.03, 0.06, world::Truth::kTerrain, world::Material::kGrass});
  side.dropped_every_m = kDroppedEvery_m;
  side.dropped_at_m = random.uniform(0, kDroppedEvery_m);
  side.dropped_share = std::min(1.0, 0.05 / plan.kerb_m);
  return side;
}

void add_houses(SceneLayout& layout, const SidePlan& plan, std::uint64_t row) {
  layout.row(row, 15, 0, [&](world::Random& random, double s_m) {
    if (random.chance(0.12)) return;
    const double depth_m = random.uniform(8, 11);
    const double wall_m = plan.houses_m() + random.uniform(0, 1.5);
    const double length_m = random.uniform(10, 15);
    const double height_m = random.uniform(5, 11);
    layout.add(make_building(length_m, depth_m, height_m),
               {s_m, plan.sign * (wall_m + depth_m / 2)});
  });
  layout.row(row + 1, 7.5, 0, [&](world::Random& random, double s_m) {
    const world::RoadPoint place{s_m, plan.sign * (plan.pavement_end_m() + 0.5)};
    if (plan.garden_m < 2 || random.chance(0.4)) return;
    if (random.chance(0.7)) {
      layout.add_along(make_hedge(6.0, random.uniform(0.8, 1.8)), place, 6.0);
    } else {
      layout.add_along(make_mesh_fence(6.0), place, 6.0);
    }
  });
}

void add_pavement(SceneLayout& layout, const SidePlan& plan, std::uint64_t row) {
  const double inner_m = plan.kerb_d_m();
  layout.row(row, 12, 0, [&](world::Random& random, double s_m) {
    const world::RoadPoint place{s_m + random.uniform(-2, 2), plan.sign * (inner_m + 0.5)};
    const double kind = random.unit();
    if (kind < 0.45) {
      layout.add(make_tree(random), place);
    } else if (kind < 0.6) {
      layout.add(make_lamp_post(random), place, plan.sign > 0 ? 0 : kAgainst_rad);
    } else if (kind < 0.75) {
      layout.add(make_sign_post(random), place, plan.sign > 0 ? kAgainst_rad : 0);
    } else if (kind < 0.85) {
      layout.add(make_bollard(), place);
    }
  });
  layout.row(row + 1, 9, 0, [&](world::Random& random, double s_m) {
    if (random.chance(0.55)) return;
    const double walk_m = random.uniform(inner_m + 1.1, plan.pavement_end_m() - 0.4);
    const bool along = random.chance(0.5);
    world::SceneObject person = make_pedestrian(random);
    const double speed_mps = random.chance(0.2) ? 0.0 : random.uniform(0.8, 1.5);
    layout.add(std::move(person), {s_m + random.uniform(-3, 3), plan.sign * walk_m},
               along ? 0 : kAgainst_rad, along ? speed_mps : -speed_mps);
  });
  if (!plan.parking) return;
  layout.row(row + 2, 6.0, 0, [&](world::Random& random, double s_m) {
    if (random.chance(0.3)) return;
    const double d_m = plan.sign * (kLane_m + kParking_m / 2 + random.uniform(-0.12, 0.12));
    const double at_m = s_m + random.uniform(-0.4, 0.4);
    const double askew_rad = random.uniform(-0.03, 0.03);
    layout.add(make_car(random), {at_m, d_m}, (plan.sign > 0 ? kAgainst_rad : 0) + askew_rad);
  });
}

void add_traffic(SceneLayout& layout, const SidePlan& right, double ego_mps) {
  layout.row(50, 32, kOncoming_mps, [&](world::Random& random, double s_m) {
    if (random.chance(0.35)) return;
    layout.add(random.chance(0.1) ? make_truck(random) : make_car(random), {s_m, 1.8}, kAgainst_rad,
               kOncoming_mps);
  });
  // All vehicles in the sensor vehicle's lane drive at its speed, so that none comes near it.
  layout.row(51, 24, ego_mps, [&](world::Random& random, double s_m) {
    if (std::abs(s_m) < 12 || random.chance(0.4)) return;
    layout.add(make_car(random), {s_m, kEgoLane_d_m}, 0, ego_mps);
  });
  layout.row(52, 40, 4.5, [&](world::Random& random, double s_m) {
    if (random.chance(0.3)) return;
    const double at_m = s_m + random.uniform(-8, 8);
    layout.add(make_cyclist(random), {at_m, -3.1}, 0, 4.5);
  });
  layout.row(53, 45, -4.5, [&](world::Random& random, double s_m) {
    if (random.chance(0.5)) return;
    const double at_m = s_m + random.uniform(-8, 8);
    layout.add(make_cyclist(random), {at_m, 3.1}, kAgainst_rad, -4.5);
  });
  // A person begins to cross from the right when the vehicle is about 50 m away, and has crossed
  // before it arrives.
  layout.row(54, 60, 0, [&](world::Random& random, double s_m) {
    if (ego_mps < 1) return;
    world::SceneObject person = make_pedestrian(random);
    const double from_m = -(right.kerb_d_m() + 0.3);
    const double walk_mps = random.uniform(1.2, 1.6);
    person.moves_from_s = (s_m - random.uniform(45, 60)) / ego_mps;
    person.moves_until_s = person.moves_from_s + 1.9 * -from_m / walk_mps;
    person.across_mps = walk_mps;
    layout.add(std::move(person), {s_m, from_m}, std::numbers::pi / 2);
  });
}

}  // namespace

Scene make_street_scene(const SceneExtent& extent) {
  world::Random random(world::mix_keys(extent.seed, 1));
  SidePlan left = plan_side(1, random);
  const SidePlan right = plan_side(-1, random);
  left.parking |= !right.parking;

  world::Road road;
  road.bend_m = random.uniform(0, 3);
  road.bend_length_m = random.uniform(350, 500);
  const double grade = random.uniform(-0.03, 0.03);
  const std::array<world::GradeProfile::Knot, 3> knots = {
      {{-60, grade}, {40, -0.5 * grade}, {160, grade}}};
  road.grade = world::GradeProfile(knots);
  road.left = road_side(left, random);
  road.right = road_side(right, random);
  road.lane_mark_d_m = 0;

  Scene scene{world::Terrain(road, world::mix_keys(extent.seed, 2)),
              {},
              kEgoLane_d_m,
              extent.speed_mps < 0 ? kSpeed_mps : extent.speed_mps};
  SceneLayout layout(scene, extent);
  add_houses(layout, left, 10);
  add_houses(layout, right, 20);
  add_pavement(layout, left, 30);
  add_pavement(layout, right, 40);
  add_traffic(layout, right, scene.ego_speed_mps);
  return scene;
}

}  // namespace terracut::scenes
