// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/simulator/object_index.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tools/lab/world/random.hpp"
#include "tools/lab/world/shape_makers.hpp"

namespace terracut::simulator {
namespace {

using Eigen::Vector3d;

scenes::Scene scene_of(std::vector<world::SceneObject> objects) {
  world::Road road;
  road.left.strips = {world::Strip{.width_m = 1}};
  road.right = road.left;
  return {world::Terrain(road, 1), std::move(objects), 0, 0};
}

world::SceneObject block(double x_m, double y_m, const Vector3d& size,
                         const world::Substance& substance) {
  world::SceneObject object;
  object.shapes = {world::box({0, 0, 0}, size, substance)};
  object.place = {x_m, y_m};
  return object;
}

TEST(ObjectIndex, NearerOfTwoIsMet) {
  const scenes::Scene scene =
      scene_of({block(20, 0, {1, 4, 4}, {world::Truth::kBuilding, world::Material::kFacade}),
                block(10, 0, {1, 1, 1}, {world::Truth::kCar, world::Material::kLightPaint})});
  ObjectIndex index(scene);
  index.update(0, 0, {0, 0, 1.7}, 0.5);
  const auto low = index.cast({{0, 0, 0.5}, Vector3d::UnitX()}, 0, 1, 120);
  const auto high = index.cast({{0, 0, 1.5}, Vector3d::UnitX()}, 0, 1, 120);
  ASSERT_TRUE(low && high);
  EXPECT_EQ(low->truth, world::Truth::kCar);
  EXPECT_NEAR(low->way_m, 9.5, 1e-9);
  EXPECT_EQ(low->label(), 10U | 2U << 16) << "the car is the scene's second object";
  EXPECT_EQ(high->truth, world::Truth::kBuilding);
  EXPECT_EQ(high->label(), 50U) << "buildings have no numbers";
  EXPECT_NEAR(high->way_m, 19.5, 1e-9);
  EXPECT_FALSE(index.cast({{0, 0, 0.5}, Vector3d::UnitX()}, 0, 1, 9));
}

TEST(ObjectIndex, MovingObjectIsMetWhereItIsAtThatTime) {
  world::SceneObject car =
      block(30, 0, {4, 2, 1.5}, {world::Truth::kCar, world::Material::kLightPaint});
  car.along_mps = -10;
  const scenes::Scene scene = scene_of({car});
  ObjectIndex index(scene);
  index.update(1.0, 0.01, {0, 0, 1.7}, 0.5);
  const world::SightLine line{{0, 0, 1}, Vector3d::UnitX()};
  EXPECT_NEAR(index.cast(line, 0, 1, 120)->way_m, 18, 1e-9);
  EXPECT_NEAR(index.cast(line, 0.01, 1, 120)->way_m, 17.9, 1e-9);
}

TEST(ObjectIndex, ObjectStandsBeforeAndAfterItsMove) {
  world::SceneObject person =
      block(20, -5, {0.5, 0.5, 1.7}, {world::Truth::kPerson, world::Material::kCloth});
  person.across_mps = 1;
  person.moves_from_s = 2;
  person.moves_until_s = 6;
  const scenes::Scene scene = scene_of({person});
  const auto y_at = [&](double time_s) {
    return world::pose_at(scene.objects[0], scene.terrain, time_s).translation().y();
  };
  EXPECT_NEAR(y_at(0), -5, 1e-12);
  EXPECT_NEAR(y_at(3), -4, 1e-12);
  EXPECT_NEAR(y_at(60), -1, 1e-12);
}

TEST(ObjectIndex, LeavesLetTheirShareOfBeamsThrough) {
  const scenes::Scene scene = scene_of(
      {block(10, 0, {0.5, 4, 4}, {world::Truth::kVegetation, world::Material::kLeaves, 2})});
  ObjectIndex index(scene);
  index.update(0, 0, {0, 0, 1}, 0.5);
  int met = 0;
  constexpr int kBeams = 20000;
  for (std::uint64_t key = 0; key < kBeams; ++key) {
    const auto hit = index.cast({{0, 0, 1}, Vector3d::UnitX()}, 0, key, 120);
    if (!hit) continue;
    ++met;
    EXPECT_GE(hit->way_m, 9.75);
    EXPECT_LE(hit->way_m, 10.25);
  }
  EXPECT_NEAR(met / double{kBeams}, 1 - std::exp(-1.0), 0.015);
}

TEST(ObjectIndex, FindsWhatASearchThroughAllObjectsFinds) {
  world::Random random(11);
  std::vector<world::SceneObject> objects;
  for (int i = 0; i < 150; ++i) {
    world::SceneObject object =
        block(random.uniform(-60, 60), random.uniform(-60, 60),
              {random.uniform(0.3, 12), random.uniform(0.3, 3), random.uniform(0.5, 5)},
              {world::Truth::kCar, world::Material::kLightPaint});
    object.heading_rad = random.uniform(-3, 3);
    objects.push_back(object);
  }
  const scenes::Scene scene = scene_of(objects);
  ObjectIndex index(scene);
  index.update(0, 0, {0, 0, 1.7}, 0.5);
  int met = 0;
  for (int i = 0; i < 5000; ++i) {
    const double azimuth_rad = random.uniform(0, 2 * std::numbers::pi);
    const world::SightLine line{
        Vector3d(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 1.7),
        Vector3d(std::cos(azimuth_rad), std::sin(azimuth_rad), random.uniform(-0.3, 0.05))
            .normalized()};
    double nearest_m = 120;
    for (const world::SceneObject& object : scene.objects) {
      const Eigen::Isometry3d inverse = world::pose_at(object, scene.terrain, 0).inverse();
      const auto chord = world::intersect(
          object.shapes[0], {inverse * line.origin, inverse.linear() * line.direction});
      if (chord && chord->in_m >= 0) nearest_m = std::min(nearest_m, chord->in_m);
    }
    const auto hit = index.cast(line, 0, 1, 120);
    EXPECT_NEAR(hit ? hit->way_m : 120, nearest_m, 1e-9);
    met += hit.has_value();
  }
  EXPECT_GT(met, 1000);
}

}  // namespace
}  // namespace terracut::simulator
