// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/scenes/scene.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "tools/lab/simulator/simulated_motion.hpp"

namespace terracut::scenes {
namespace {

constexpr std::uint64_t kSeeds = 6;

Scene scene(std::string_view name, std::uint64_t seed, double duration_s = 5) {
  auto made = make_scene(name, {seed, duration_s, -1});
  EXPECT_TRUE(made) << made.error().message;
  return std::move(*made);
}

TEST(Scene, UnknownNameIsRefusedWithTheNamesThereAre) {
  const auto made = make_scene("moon", {});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::kInvalidArgument);
  for (const std::string_view name : scene_names()) {
    EXPECT_NE(made.error().message.find(name), std::string::npos);
  }
}

TEST(Scene, SeedsDiffer) {
  EXPECT_NE(scene("street", 1).objects.size() * 1000 + scene("highway", 1).objects.size(),
            scene("street", 2).objects.size() * 1000 + scene("highway", 2).objects.size());
}

TEST(Scene, IsTheSameWithEveryCompiler) {
  // Sums over all shapes of seed 1. They change with the scenes, but must not with the compiler.
  const std::array<double, 5> expected_m = {44400.7944, 45618.0149, 23057.6110, 439.1000,
                                            32659.9124};
  for (std::size_t i = 0; i < expected_m.size(); ++i) {
    double sum_m = 0;
    const Scene world = scene(scene_names()[i], 1);
    for (const world::SceneObject& object : world.objects) {
      sum_m += object.place.s_m + 3 * object.place.d_m + 5 * object.heading_rad;
      for (const world::Shape& shape : object.shapes)
        sum_m += 7 * shape.centre.sum() + 11 * shape.half.sum();
    }
    for (double s_m = 0; s_m < 50; s_m += 0.7) {
      for (double d_m = -20; d_m < 20; d_m += 0.9) sum_m += world.terrain.height_m(s_m, d_m);
    }
    EXPECT_NEAR(sum_m, expected_m[i], 1e-3) << scene_names()[i];
  }
}

TEST(Scene, LongerDriveSeesEverythingOfAShorterOne) {
  for (const std::string_view name : scene_names()) {
    const Scene brief = scene(name, 3, 2);
    const Scene longer = scene(name, 3, 8);
    std::set<std::uint64_t> keys;
    for (const world::SceneObject& object : longer.objects) keys.insert(object.key);
    for (const world::SceneObject& object : brief.objects)
      EXPECT_TRUE(keys.contains(object.key)) << name;
    EXPECT_EQ(brief.terrain.height_m(50, 7), longer.terrain.height_m(50, 7));
  }
}

TEST(Scene, VehiclesStandOnTheGroundWithAllWheels) {
  for (const std::string_view name : scene_names()) {
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const Scene world = scene(name, seed);
      for (const world::SceneObject& object : world.objects) {
        for (const world::Shape& shape : object.shapes) {
          if (shape.kind != world::ShapeKind::kWheel) continue;
          const Eigen::Vector3d foot = world::pose_at(object, world.terrain, 1.0) *
                                       (shape.centre - Eigen::Vector3d(0, 0, shape.half.x()));
          EXPECT_NEAR(foot.z(), world.terrain.height_m(foot.x(), foot.y()), 0.06)
              << name << " seed " << seed << " at " << foot.transpose();
        }
      }
    }
  }
}

TEST(Scene, ParkedCarsStandOnTheParkingStrip) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene world = scene("street", seed);
    int parked = 0;
    for (const world::SceneObject& object : world.objects) {
      if (object.moves() || object.shapes[0].truth != world::Truth::kCar) continue;
      ++parked;
      const Eigen::Vector3d at = world::pose_at(object, world.terrain, 0).translation();
      EXPECT_EQ(world.terrain.strip(at.x(), at.y()).truth, world::Truth::kParking);
    }
    EXPECT_GT(parked, 5) << "seed " << seed;
  }
}

TEST(Scene, KerbsAreFiveToTwentyCentimetresHigh) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene world = scene("street", seed);
    for (const double sign : {1.0, -1.0}) {
      for (double s_m = 0; s_m < 80; s_m += 0.5) {
        double d_m = 0;
        const auto truth = [&](double at_m) {
          return world.terrain.strip(s_m, world.terrain.road().y_m({s_m, sign * at_m})).truth;
        };
        while (truth(d_m) != world::Truth::kSidewalk) d_m += 0.0005;
        const auto height_m = [&](double at_m) {
          return world.terrain.height_m(s_m, world.terrain.road().y_m({s_m, sign * at_m}));
        };
        const double kerb_m = height_m(d_m) - height_m(d_m - 0.001);
        EXPECT_GE(kerb_m, 0.049) << "seed " << seed << " at " << s_m;
        EXPECT_LE(kerb_m, 0.201);
      }
    }
  }
}

TEST(Scene, HillRisesFifteenPercent) {
  const Scene world = scene("hill", 1);
  EXPECT_NEAR(world.terrain.road().grade.grade(80), 0.15, 1e-12);
}

TEST(Scene, VehicleDrivesOnTheRoad) {
  for (const std::string_view name : scene_names()) {
    const Scene world = scene(name, 1);
    for (double time_s = 0; time_s < 5; time_s += 0.05) {
      const Eigen::Isometry3d pose = simulator::ego_pose(world, time_s);
      for (const double y_m : {-0.8, 0.8}) {
        const Eigen::Vector3d wheel = pose * Eigen::Vector3d(1.35, y_m, 0);
        EXPECT_EQ(world.terrain.strip(wheel.x(), wheel.y()).truth, world::Truth::kRoad) << name;
      }
    }
  }
}

/// Whether something solid reaches into the body of the vehicle.
bool touches_vehicle(const world::SceneObject& object, const Eigen::Isometry3d& T_object_vehicle) {
  for (double x_m = -2.2; x_m < 2.3; x_m += 0.4) {
    for (double y_m = -0.9; y_m < 1.0; y_m += 0.45) {
      for (const double z_m : {0.3, 0.8, 1.3}) {
        const world::SightLine line{T_object_vehicle * Eigen::Vector3d(x_m, y_m, z_m),
                                    Eigen::Vector3d::UnitX()};
        for (const world::Shape& shape : object.shapes) {
          const auto chord = world::intersect(shape, line);
          if (chord && chord->in_m < 0 && chord->out_m > 0) return true;
        }
      }
    }
  }
  return false;
}

TEST(Scene, NobodyMeetsTheVehicle) {
  for (const std::string_view name : scene_names()) {
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const Scene world = scene(name, seed, 10);
      for (double time_s = -0.05; time_s < 10; time_s += 0.15) {
        const Eigen::Isometry3d T_world_vehicle = simulator::ego_pose(world, time_s);
        for (const world::SceneObject& object : world.objects) {
          const Eigen::Isometry3d T_world_object = world::pose_at(object, world.terrain, time_s);
          const world::BoundingSphere sphere = world::bounding_sphere(object);
          const double apart_m =
              (T_world_object * sphere.centre - T_world_vehicle.translation()).norm();
          if (apart_m > sphere.radius_m + 3) continue;
          EXPECT_FALSE(touches_vehicle(object, T_world_object.inverse() * T_world_vehicle))
              << name << " seed " << seed << ", truth " << static_cast<int>(object.shapes[0].truth)
              << ", " << time_s << " s";
        }
      }
    }
  }
}

}  // namespace
}  // namespace terracut::scenes
