// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "roadside.hpp"

#include "tools/lab/world/shape_makers.hpp"

namespace terracut::scenes {
namespace {

constexpr double kBelowGround_m = 0.6;
constexpr double kFoundation_m = 3.0;

}  // namespace

world::SceneObject make_building(double length_m, double depth_m, double height_m) {
  const world::Substance wall{world::Truth::kBuilding, world::Material::kFacade};
  world::SceneObject building;
  building.shapes.push_back(
      world::box({0, 0, -kFoundation_m}, {length_m, depth_m, kFoundation_m + 0.5}, wall));
  building.shapes.push_back(
      world::box({0, 0, 0.5}, {length_m - 0.1, depth_m - 0.1, height_m - 0.5}, wall));
  world::Shape roof = world::box({0, 0, height_m}, {length_m + 0.4, depth_m + 0.6, 3.0}, wall);
  roof.side_inset_m = depth_m / 2;
  building.shapes.push_back(roof);
  return building;
}

world::SceneObject make_tree(world::Random& random) {
  const double radius_m = random.uniform(0.1, 0.25);
  const double bare_m = random.uniform(2.2, 3.2);
  const Eigen::Vector3d size{random.uniform(2.5, 5.5), random.uniform(2.5, 5.5),
                             random.uniform(3.0, 6.0)};
  const Eigen::Vector3d crown{random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), bare_m};
  world::SceneObject tree;
  tree.shapes.push_back(world::post({0, 0, -kBelowGround_m}, radius_m,
                                    kBelowGround_m + bare_m + size.z() / 2,
                                    {world::Truth::kTrunk, world::Material::kBark}));
  tree.shapes.push_back(
      world::ellipsoid(crown, size, {world::Truth::kVegetation, world::Material::kLeaves, 0.9}));
  return tree;
}

world::SceneObject make_bush(world::Random& random) {
  const double width_m = random.uniform(0.5, 1.6);
  const double high_m = random.uniform(0.5, 1.3);
  world::SceneObject bush;
  bush.shapes.push_back(world::ellipsoid(
      {0, 0, -0.3 * high_m}, {width_m, width_m * random.uniform(0.7, 1.3), 1.3 * high_m},
      {world::Truth::kVegetation, world::Material::kLeaves, 5}));
  return bush;
}

world::SceneObject make_lamp_post(world::Random& random) {
  const double high_m = random.uniform(5.0, 8.0);
  const world::Substance metal{world::Truth::kPole, world::Material::kMetal};
  world::SceneObject lamp;
  lamp.shapes.push_back(world::post({0, 0, -kBelowGround_m}, 0.08, kBelowGround_m + high_m, metal));
  lamp.shapes.push_back(world::box({0, -0.6, high_m}, {0.25, 1.4, 0.12}, metal));
  return lamp;
}

world::SceneObject make_sign_post(world::Random& random) {
  const double high_m = random.uniform(2.2, 2.8);
  world::SceneObject sign;
  sign.shapes.push_back(world::post({0, 0, -kBelowGround_m}, 0.035, kBelowGround_m + high_m,
                                    {world::Truth::kPole, world::Material::kMetal}));
  sign.shapes.push_back(world::box({-0.05, 0, high_m - 0.7}, {0.02, 0.6, 0.65},
                                   {world::Truth::kPole, world::Material::kSign}));
  return sign;
}

world::SceneObject make_bollard() {
  world::SceneObject bollard;
  bollard.shapes.push_back(world::post({0, 0, -kBelowGround_m}, 0.07, kBelowGround_m + 0.9,
                                       {world::Truth::kPole, world::Material::kMetal}));
  return bollard;
}

world::SceneObject make_hedge(double length_m, double height_m) {
  world::SceneObject hedge;
  world::Shape leaves =
      world::box({0, 0, -kBelowGround_m}, {length_m, 0.8, kBelowGround_m + height_m},
                 {world::Truth::kVegetation, world::Material::kLeaves, 8});
  leaves.side_inset_m = 0.1;
  hedge.shapes.push_back(leaves);
  return hedge;
}

world::SceneObject make_mesh_fence(double length_m) {
  world::SceneObject fence;
  const world::Substance post_wood{world::Truth::kFence, world::Material::kWood};
  for (double x_m = -length_m / 2; x_m < length_m / 2; x_m += 2.5) {
    fence.shapes.push_back(
        world::post({x_m, 0, -kBelowGround_m}, 0.05, kBelowGround_m + 1.3, post_wood));
  }
  fence.shapes.push_back(world::box({0, 0, -0.1}, {length_m, 0.04, 1.3},
                                    {world::Truth::kFence, world::Material::kMetal, 12}));
  return fence;
}

world::SceneObject make_guard_rail(double length_m) {
  const world::Substance steel{world::Truth::kFence, world::Material::kMetal};
  world::SceneObject rail;
  for (double x_m = -length_m / 2 + 1; x_m < length_m / 2; x_m += 2.0) {
    rail.shapes.push_back(
        world::box({x_m, 0, -kBelowGround_m}, {0.06, 0.1, kBelowGround_m + 0.7}, steel));
  }
  rail.shapes.push_back(world::box({0, 0, 0.45}, {length_m, 0.18, 0.31}, steel));
  return rail;
}

world::SceneObject make_concrete_barrier(double length_m) {
  const world::Substance concrete{world::Truth::kFence, world::Material::kFacade};
  world::SceneObject barrier;
  barrier.shapes.push_back(
      world::box({0, 0, -kBelowGround_m}, {length_m, 0.6, kBelowGround_m + 0.1}, concrete));
  world::Shape wall = world::box({0, 0, 0.1}, {length_m, 0.5, 0.8}, concrete);
  wall.side_inset_m = 0.15;
  barrier.shapes.push_back(wall);
  return barrier;
}

world::SceneObject make_overpass(double clear_width_m) {
  const world::Substance concrete{world::Truth::kBuilding, world::Material::kFacade};
  world::SceneObject bridge;
  bridge.shapes.push_back(world::box({0, 0, 5.2}, {10, clear_width_m + 12, 1.4}, concrete));
  for (const double side : {-1.0, 1.0}) {
    bridge.shapes.push_back(world::box({0, side * (clear_width_m / 2 + 0.5), -kFoundation_m},
                                       {9, 1.0, kFoundation_m + 5.2}, concrete));
  }
  return bridge;
}

}  // namespace terracut::scenes
