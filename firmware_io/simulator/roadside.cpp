// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/simulator/roadside.hpp"

#include "firmware_io/simulator/shape_makers.hpp"

namespace terracut::firmware_io {
namespace {

constexpr double kBelowGround_m = 0.6;
constexpr double kFoundation_m = 3.0;

}  // namespace

SceneObject make_building(double length_m, double depth_m, double height_m) {
  const Substance wall{Truth::kBuilding, Material::kFacade};
  SceneObject building;
  building.shapes.push_back(
      box({0, 0, -kFoundation_m}, {length_m, depth_m, kFoundation_m + 0.5}, wall));
  building.shapes.push_back(
      box({0, 0, 0.5}, {length_m - 0.1, depth_m - 0.1, height_m - 0.5}, wall));
  Shape roof = box({0, 0, height_m}, {length_m + 0.4, depth_m + 0.6, 3.0}, wall);
  roof.side_inset_m = depth_m / 2;
  building.shapes.push_back(roof);
  return building;
}

SceneObject make_tree(Random& random) {
  const double radius_m = random.uniform(0.1, 0.25);
  const double bare_m = random.uniform(2.2, 3.2);
  const Eigen::Vector3d size{random.uniform(2.5, 5.5), random.uniform(2.5, 5.5),
                             random.uniform(3.0, 6.0)};
  const Eigen::Vector3d crown{random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), bare_m};
  SceneObject tree;
  tree.shapes.push_back(post({0, 0, -kBelowGround_m}, radius_m,
                             kBelowGround_m + bare_m + size.z() / 2,
                             {Truth::kTrunk, Material::kBark}));
  tree.shapes.push_back(ellipsoid(crown, size, {Truth::kVegetation, Material::kLeaves, 0.9}));
  return tree;
}

SceneObject make_bush(Random& random) {
  const double width_m = random.uniform(0.5, 1.6);
  const double high_m = random.uniform(0.5, 1.3);
  SceneObject bush;
  bush.shapes.push_back(ellipsoid({0, 0, -0.3 * high_m},
                                  {width_m, width_m * random.uniform(0.7, 1.3), 1.3 * high_m},
                                  {Truth::kVegetation, Material::kLeaves, 5}));
  return bush;
}

SceneObject make_lamp_post(Random& random) {
  const double high_m = random.uniform(5.0, 8.0);
  const Substance metal{Truth::kPole, Material::kMetal};
  SceneObject lamp;
  lamp.shapes.push_back(post({0, 0, -kBelowGround_m}, 0.08, kBelowGround_m + high_m, metal));
  lamp.shapes.push_back(box({0, -0.6, high_m}, {0.25, 1.4, 0.12}, metal));
  return lamp;
}

SceneObject make_sign_post(Random& random) {
  const double high_m = random.uniform(2.2, 2.8);
  SceneObject sign;
  sign.shapes.push_back(post({0, 0, -kBelowGround_m}, 0.035, kBelowGround_m + high_m,
                             {Truth::kPole, Material::kMetal}));
  sign.shapes.push_back(
      box({-0.05, 0, high_m - 0.7}, {0.02, 0.6, 0.65}, {Truth::kPole, Material::kSign}));
  return sign;
}

SceneObject make_bollard() {
  SceneObject bollard;
  bollard.shapes.push_back(
      post({0, 0, -kBelowGround_m}, 0.07, kBelowGround_m + 0.9, {Truth::kPole, Material::kMetal}));
  return bollard;
}

SceneObject make_hedge(double length_m, double height_m) {
  SceneObject hedge;
  Shape leaves = box({0, 0, -kBelowGround_m}, {length_m, 0.8, kBelowGround_m + height_m},
                     {Truth::kVegetation, Material::kLeaves, 8});
  leaves.side_inset_m = 0.1;
  hedge.shapes.push_back(leaves);
  return hedge;
}

SceneObject make_mesh_fence(double length_m) {
  SceneObject fence;
  const Substance post_wood{Truth::kFence, Material::kWood};
  for (double x_m = -length_m / 2; x_m < length_m / 2; x_m += 2.5) {
    fence.shapes.push_back(post({x_m, 0, -kBelowGround_m}, 0.05, kBelowGround_m + 1.3, post_wood));
  }
  fence.shapes.push_back(
      box({0, 0, -0.1}, {length_m, 0.04, 1.3}, {Truth::kFence, Material::kMetal, 12}));
  return fence;
}

SceneObject make_guard_rail(double length_m) {
  const Substance steel{Truth::kFence, Material::kMetal};
  SceneObject rail;
  for (double x_m = -length_m / 2 + 1; x_m < length_m / 2; x_m += 2.0) {
    rail.shapes.push_back(box({x_m, 0, -kBelowGround_m}, {0.06, 0.1, kBelowGround_m + 0.7}, steel));
  }
  rail.shapes.push_back(box({0, 0, 0.45}, {length_m, 0.18, 0.31}, steel));
  return rail;
}

SceneObject make_concrete_barrier(double length_m) {
  const Substance concrete{Truth::kFence, Material::kFacade};
  SceneObject barrier;
  barrier.shapes.push_back(
      box({0, 0, -kBelowGround_m}, {length_m, 0.6, kBelowGround_m + 0.1}, concrete));
  Shape wall = box({0, 0, 0.1}, {length_m, 0.5, 0.8}, concrete);
  wall.side_inset_m = 0.15;
  barrier.shapes.push_back(wall);
  return barrier;
}

SceneObject make_overpass(double clear_width_m) {
  const Substance concrete{Truth::kBuilding, Material::kFacade};
  SceneObject bridge;
  bridge.shapes.push_back(box({0, 0, 5.2}, {10, clear_width_m + 12, 1.4}, concrete));
  for (const double side : {-1.0, 1.0}) {
    bridge.shapes.push_back(box({0, side * (clear_width_m / 2 + 0.5), -kFoundation_m},
                                {9, 1.0, kFoundation_m + 5.2}, concrete));
  }
  return bridge;
}

}  // namespace terracut::firmware_io
