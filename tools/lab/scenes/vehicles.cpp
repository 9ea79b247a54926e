// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "vehicles.hpp"

#include "tools/lab/world/shape_makers.hpp"

namespace terracut::scenes {
namespace {

void add_axle(world::SceneObject& vehicle, double x_m, double track_m, double radius_m,
              double width_m, world::Truth truth) {
  const world::Substance rubber{truth, world::Material::kRubber};
  vehicle.shapes.push_back(world::wheel({x_m, track_m / 2, 0}, radius_m, width_m, rubber));
  vehicle.shapes.push_back(world::wheel({x_m, -track_m / 2, 0}, radius_m, width_m, rubber));
}

}  // namespace

world::SceneObject make_car(world::Random& random) {
  const double length_m = random.uniform(3.8, 4.8);
  const double width_m = random.uniform(1.75, 1.9);
  const double height_m = random.uniform(1.45, 1.7);
  const double clearance_m = random.uniform(0.18, 0.24);
  const double belt_m = random.uniform(0.85, 0.95);
  const world::Substance paint{world::Truth::kCar, random.chance(0.3)
                                                       ? world::Material::kDarkPaint
                                                       : world::Material::kLightPaint};

  world::SceneObject car;
  car.stance = world::Stance::kOnWheels;
  car.half_base_m = 0.3 * length_m;
  car.half_track_m = 0.42 * width_m;

  // The body reaches up to the belt line and is lower over the bonnet; above it are windows all
  // round, and a roof.
  const double bonnet_m = 0.25 * length_m;
  const double cabin_m = length_m - bonnet_m - (random.chance(0.5) ? 0.1 : 0.7);
  const double cabin_x_m = length_m / 2 - bonnet_m - cabin_m / 2;
  car.shapes.push_back(
      world::box({0, 0, clearance_m}, {length_m, width_m, 0.75 - clearance_m}, paint));
  world::Shape upper =
      world::box({-bonnet_m / 2, 0, 0.75}, {length_m - bonnet_m, width_m, belt_m - 0.75}, paint);
  upper.front_inset_m = 0.1;
  car.shapes.push_back(upper);
  world::Shape windows =
      world::box({cabin_x_m, 0, belt_m}, {cabin_m, width_m - 0.1, height_m - 0.06 - belt_m},
                 {world::Truth::kCar, world::Material::kGlass});
  windows.front_inset_m = 0.55;
  windows.rear_inset_m = 0.3;
  windows.side_inset_m = 0.15;
  car.shapes.push_back(windows);
  world::Shape roof = world::box({cabin_x_m - 0.12, 0, height_m - 0.06},
                                 {cabin_m - 0.85, width_m - 0.4, 0.06}, paint);
  roof.side_inset_m = 0.05;
  car.shapes.push_back(roof);

  const double track_m = width_m - 0.22;
  add_axle(car, 0.31 * length_m, track_m, 0.32, 0.2, world::Truth::kCar);
  add_axle(car, -0.29 * length_m, track_m, 0.32, 0.2, world::Truth::kCar);
  return car;
}

world::SceneObject make_truck(world::Random& random) {
  const double trailer_m = random.uniform(8.5, 13.0);
  const double height_m = random.uniform(3.6, 4.0);
  const double length_m = trailer_m + 3.2;
  const world::Substance paint{world::Truth::kTruck, world::Material::kLightPaint};
  const world::Substance frame{world::Truth::kTruck, world::Material::kDarkPaint};

  world::SceneObject truck;
  truck.stance = world::Stance::kOnWheels;
  truck.half_base_m = 0.36 * length_m;
  truck.half_track_m = 1.0;

  const double front_m = length_m / 2;
  const double rear_m = -length_m / 2;
  world::Shape cab = world::box({front_m - 1.1, 0, 0.45}, {2.2, 2.45, height_m - 0.7}, paint);
  cab.front_inset_m = 0.15;
  truck.shapes.push_back(cab);
  truck.shapes.push_back(
      world::box({rear_m + trailer_m / 2, 0, 1.15}, {trailer_m, 2.5, height_m - 1.15}, paint));
  truck.shapes.push_back(world::box({0, 0, 0.75}, {length_m - 1.0, 0.9, 0.3}, frame));
  truck.shapes.push_back(
      world::box({rear_m + 0.15, 0, 0.45}, {0.15, 2.3, 0.15}, frame));  // under-run bar

  add_axle(truck, front_m - 1.3, 2.1, 0.5, 0.32, world::Truth::kTruck);
  add_axle(truck, front_m - 4.6, 1.95, 0.5, 0.55, world::Truth::kTruck);
  add_axle(truck, rear_m + 1.8, 1.95, 0.5, 0.55, world::Truth::kTruck);
  add_axle(truck, rear_m + 3.1, 1.95, 0.5, 0.55, world::Truth::kTruck);
  return truck;
}

}  // namespace terracut::scenes
