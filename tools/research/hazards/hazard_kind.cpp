// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "hazard_kind.hpp"

#include <array>

#include "tools/lab/world/shape_makers.hpp"

namespace terracut::hazards {
namespace {

using world::Random;
using world::Substance;
using world::Truth;

/// Depth to which shapes reach into the ground, because it is uneven.
constexpr double kSunk_m = 0.05;

constexpr Substance kCloth{Truth::kPerson, world::Material::kCloth};
constexpr Substance kThing{Truth::kFence, world::Material::kWood};
constexpr Substance kPaint{Truth::kTruck, world::Material::kLightPaint};

/// Returns a box on the ground with its middle at (x, y).
world::Shape standing_box(double x_m, double y_m, double length_m, double width_m, double height_m,
                          const Substance& substance) {
  return world::box({x_m, y_m, -kSunk_m}, {length_m, width_m, height_m + kSunk_m}, substance);
}

world::Shape standing_post(double x_m, double y_m, double radius_m, double height_m,
                           const Substance& substance) {
  return world::post({x_m, y_m, -kSunk_m}, radius_m, height_m + kSunk_m, substance);
}

Hazard lying_person(Random&) {
  return {.body = {standing_box(0, 0, 1.7, 0.45, 0.28, kCloth)}};
}

Hazard sitting_person(Random&) {
  return {.body = {standing_box(-0.25, 0, 0.3, 0.45, 0.65, kCloth),
                   standing_box(0.3, 0, 0.8, 0.35, 0.15, kCloth),
                   world::ellipsoid({-0.25, 0, 0.63}, {0.2, 0.17, 0.22}, kCloth)}};
}

Hazard child(Random& random) {
  const double tall_m = random.uniform(0.9, 1.2);
  return {.body = {standing_post(0, 0, 0.12, 0.8 * tall_m, kCloth),
                   world::ellipsoid({0, 0, 0.78 * tall_m}, {0.18, 0.16, 0.22 * tall_m}, kCloth)}};
}

/// Makes a dog.
Hazard animal(Random& random) {
  const double tall_m = random.uniform(0.4, 0.65);
  Hazard dog{
      .body = {world::ellipsoid({0, 0, 0.45 * tall_m}, {1.3 * tall_m, 0.25, 0.5 * tall_m}, kThing),
               world::ellipsoid({0.6 * tall_m, 0, 0.7 * tall_m}, {0.4 * tall_m, 0.15, 0.3 * tall_m},
                                kThing)}};
  for (const double x : {-0.4, 0.4}) {
    for (const double y_m : {-0.08, 0.08}) {
      dog.body.push_back(standing_post(x * tall_m, y_m, 0.03, 0.55 * tall_m, kThing));
    }
  }
  return dog;
}

Hazard box_20cm(Random&) {
  return {.body = {standing_box(0, 0, 0.5, 0.5, 0.20, kThing)}};
}

Hazard box_30cm(Random&) {
  return {.body = {standing_box(0, 0, 0.5, 0.5, 0.30, kThing)}};
}

/// Makes a tyre that lies on its side.
Hazard tyre(Random&) {
  return {.body = {standing_post(0, 0, 0.33, 0.22, kThing)}};
}

Hazard bollard(Random&) {
  return {.body = {standing_post(0, 0, 0.08, 0.9, kThing)}};
}

Hazard pallet(Random&) {
  return {.body = {standing_box(0, 0, 1.2, 0.8, 0.15, kThing)}};
}

/// Makes a bough with leafy twigs, through which about half of the beams pass.
Hazard branch(Random& random) {
  const double length_m = random.uniform(1.5, 2.5);
  Substance leaves = kThing;
  leaves.density_per_m = 1.5;
  return {.body = {standing_box(0, 0, length_m, 0.12, 0.12, kThing),
                   world::ellipsoid({0.2 * length_m, 0, -kSunk_m}, {0.6 * length_m, 0.9, 0.45},
                                    leaves)}};
}

/// Makes a plate that rises to the truck behind it. Its rim faces the sensor.
Hazard tail_lift(Random& random) {
  constexpr double kLength_m = 1.7, kWidth_m = 2.4, kHeight_m = 0.25;
  const double rim_m = random.uniform(0.05, 0.10);
  world::Shape ramp = world::box({0, 0, rim_m}, {kLength_m, kWidth_m, kHeight_m - rim_m}, kPaint);
  ramp.rear_inset_m = kLength_m;
  const double rear_m = kLength_m / 2;
  Hazard lift{.body = {standing_box(0, 0, kLength_m, kWidth_m, rim_m, kPaint), ramp},
              .beside = {world::box({rear_m + 3, 0, 1.0}, {6, 2.5, 2.6}, kPaint)},
              .nearest_m = 6,
              .farthest_m = 8,
              .faces_sensor = true};
  for (const double y_m : {-1.0, 1.0}) {
    lift.beside.push_back(world::wheel({rear_m + 1.5, y_m, 0}, 0.5, 0.5, kPaint));
  }
  return lift;
}

Hazard manhole(Random&) {
  return {.hole = world::post({0, 0, -1.5}, 0.35, 1.5, kThing)};
}

Hazard kerb_stone(Random& random) {
  return {.body = {standing_box(0, 0, 1.0, 0.15, random.uniform(0.10, 0.15), kThing)}};
}

constexpr std::array kKinds{
    HazardKind{"lying_person", lying_person},
    HazardKind{"sitting_person", sitting_person},
    HazardKind{"child", child},
    HazardKind{"animal", animal},
    HazardKind{"box_20cm", box_20cm},
    HazardKind{"box_30cm", box_30cm},
    HazardKind{"tyre", tyre},
    HazardKind{"bollard", bollard},
    HazardKind{"pallet", pallet},
    HazardKind{"branch", branch},
    HazardKind{"tail_lift", tail_lift},
    HazardKind{"manhole", manhole},
    HazardKind{"kerb_stone", kerb_stone},
};

}  // namespace

std::span<const HazardKind> hazard_kinds() noexcept {
  return kKinds;
}

}  // namespace terracut::hazards
