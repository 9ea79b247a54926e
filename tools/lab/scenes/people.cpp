// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "people.hpp"

#include "tools/lab/world/shape_makers.hpp"

namespace terracut::scenes {

world::SceneObject make_pedestrian(world::Random& random) {
  const double tall_m = random.chance(0.15) ? random.uniform(1.1, 1.4) : random.uniform(1.55, 1.95);
  const double stride_m = random.uniform(0.0, 0.2);
  const world::Substance cloth{world::Truth::kPerson, world::Material::kCloth};
  const double hip_m = 0.48 * tall_m;
  const double head_m = 0.13 * tall_m;

  world::SceneObject person;
  person.shapes.push_back(world::post({stride_m, 0.11, -0.03}, 0.08, hip_m + 0.03, cloth));
  person.shapes.push_back(world::post({-stride_m, -0.11, -0.03}, 0.08, hip_m + 0.03, cloth));
  person.shapes.push_back(
      world::ellipsoid({0, 0, hip_m - 0.1}, {0.3, 0.52, tall_m - head_m - hip_m + 0.12}, cloth));
  person.shapes.push_back(world::ellipsoid({0, 0, tall_m - head_m}, {0.2, 0.17, head_m}, cloth));
  return person;
}

world::SceneObject make_cyclist(world::Random& random) {
  const double tall_m = random.uniform(1.6, 1.8);  // Height above the ground, on the saddle.
  const world::Substance cloth{world::Truth::kBicyclist, world::Material::kCloth};
  const world::Substance metal{world::Truth::kBicyclist, world::Material::kMetal};
  const world::Substance rubber{world::Truth::kBicyclist, world::Material::kRubber};

  world::SceneObject cyclist;
  cyclist.stance = world::Stance::kOnWheels;
  cyclist.half_base_m = 0.52;
  cyclist.half_track_m = 0.1;
  // Spokes let nearly all light through, so the wheel's density is its tyre's share of a disc.
  cyclist.shapes.push_back(
      world::wheel({0.52, 0, 0}, 0.34, 0.04, {rubber.truth, rubber.material, 10}));
  cyclist.shapes.push_back(
      world::wheel({-0.52, 0, 0}, 0.34, 0.04, {rubber.truth, rubber.material, 10}));
  cyclist.shapes.push_back(world::box({0, 0, 0.3}, {0.95, 0.06, 0.08}, metal));
  cyclist.shapes.push_back(world::box({0, 0, 0.78}, {0.9, 0.06, 0.06}, metal));
  cyclist.shapes.push_back(world::box({0.45, 0, 0.95}, {0.08, 0.55, 0.06}, metal));  // handle bar
  cyclist.shapes.push_back(world::post({0.02, 0.12, 0.25}, 0.07, 0.75, cloth));
  cyclist.shapes.push_back(world::post({0.02, -0.12, 0.35}, 0.07, 0.65, cloth));
  cyclist.shapes.push_back(
      world::ellipsoid({0.05, 0, 0.88}, {0.45, 0.48, tall_m - 0.22 - 0.88}, cloth));
  cyclist.shapes.push_back(world::ellipsoid({0.2, 0, tall_m - 0.24}, {0.22, 0.18, 0.24}, cloth));
  return cyclist;
}

}  // namespace terracut::scenes
