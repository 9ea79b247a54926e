// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/world/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/lab/world/random.hpp"
#include "tools/lab/world/shape_makers.hpp"

namespace terracut::world {
namespace {

using Eigen::Vector3d;

constexpr Substance kAny{};

SightLine towards(const Vector3d& from, const Vector3d& to) {
  return {from, (to - from).normalized()};
}

TEST(Shapes, BoxIsMetAtItsFaceAndLeftAtTheOther) {
  const auto chord =
      intersect(box({10, 0, 0}, {4, 2, 1}, kAny), {{0, 0.5, 0.5}, Vector3d::UnitX()});
  ASSERT_TRUE(chord);
  EXPECT_NEAR(chord->in_m, 8, 1e-12);
  EXPECT_NEAR(chord->out_m, 12, 1e-12);
  EXPECT_TRUE(chord->normal.isApprox(-Vector3d::UnitX()));
}

TEST(Shapes, BoxIsMissedBesideAndAbove) {
  const Shape shape = box({10, 0, 0}, {4, 2, 1}, kAny);
  EXPECT_FALSE(intersect(shape, {{0, 1.01, 0.5}, Vector3d::UnitX()}));
  EXPECT_FALSE(intersect(shape, {{0, 0, 1.01}, Vector3d::UnitX()}));
}

TEST(Shapes, LeaningFrontIsMetLaterHigherUp) {
  Shape cabin = box({0, 0, 0}, {4, 2, 1}, kAny);
  cabin.front_inset_m = 0.5;
  const auto low = intersect(cabin, {{10, 0, 0.2}, -Vector3d::UnitX()});
  const auto high = intersect(cabin, {{10, 0, 0.8}, -Vector3d::UnitX()});
  ASSERT_TRUE(low && high);
  EXPECT_NEAR(low->in_m, 8 + 0.5 * 0.2, 1e-12);
  EXPECT_NEAR(high->in_m, 8 + 0.5 * 0.8, 1e-12);
  EXPECT_NEAR(low->normal.z() / low->normal.x(), 0.5, 1e-12);
}

TEST(Shapes, PostIsRoundAndEndsAtItsTop) {
  const Shape shape = post({5, 0, 0}, 0.5, 3, kAny);
  const auto chord = intersect(shape, {{0, 0.3, 1}, Vector3d::UnitX()});
  ASSERT_TRUE(chord);
  EXPECT_NEAR(chord->in_m, 5 - 0.4, 1e-12);
  EXPECT_FALSE(intersect(shape, {{0, 0, 3.01}, Vector3d::UnitX()}));
  const auto from_above = intersect(shape, {{5, 0.1, 10}, -Vector3d::UnitZ()});
  ASSERT_TRUE(from_above);
  EXPECT_NEAR(from_above->in_m, 7, 1e-12);
  EXPECT_TRUE(from_above->normal.isApprox(Vector3d::UnitZ()));
}

TEST(Shapes, WheelStandsOnItsFoot) {
  const auto chord = intersect(wheel({0, 0, 0}, 0.3, 0.2, kAny), {{0, 0, 5}, -Vector3d::UnitZ()});
  ASSERT_TRUE(chord);
  EXPECT_NEAR(chord->in_m, 5 - 0.6, 1e-12);
  EXPECT_NEAR(chord->out_m, 5, 1e-12);
}

TEST(Shapes, LineThatStartsInsideEntersBehindItsStart) {
  const auto chord =
      intersect(ellipsoid({0, 0, -1}, {2, 2, 2}, kAny), {{0, 0, 0}, Vector3d::UnitX()});
  ASSERT_TRUE(chord);
  EXPECT_NEAR(chord->in_m, -1, 1e-12);
  EXPECT_NEAR(chord->out_m, 1, 1e-12);
}

/// How far outside of a shape a place is, by its definition; about 0 on its surface.
double outside(const Shape& shape, const Vector3d& place) {
  const Vector3d p = place - shape.centre;
  const Vector3d& half = shape.half;
  switch (shape.kind) {
    case ShapeKind::kPost:
      return std::max(std::hypot(p.x(), p.y()) - half.x(), std::abs(p.z()) - half.z());
    case ShapeKind::kWheel:
      return std::max(std::hypot(p.x(), p.z()) - half.x(), std::abs(p.y()) - half.y());
    case ShapeKind::kEllipsoid:
      return p.cwiseQuotient(half).norm() - 1;
    case ShapeKind::kBox:
      break;
  }
  const double up = (p.z() + half.z()) / (2 * half.z());
  const double front = half.x() - up * shape.front_inset_m;
  const double rear = half.x() - up * shape.rear_inset_m;
  const double side = half.y() - up * shape.side_inset_m;
  return std::max(
      {p.x() - front, -p.x() - rear, std::abs(p.y()) - side, std::abs(p.z()) - half.z()});
}

TEST(Shapes, ChordsEndOnTheSurfaceAndRunInsideForRandomLines) {
  Random random(7);
  int met = 0;
  for (int i = 0; i < 20000; ++i) {
    Shape shape =
        box({random.uniform(-1, 1), random.uniform(-1, 1), 0},
            {random.uniform(0.5, 4), random.uniform(0.5, 4), random.uniform(0.5, 4)}, kAny);
    shape.kind = static_cast<ShapeKind>(random.pick(4));
    if (shape.kind == ShapeKind::kBox) {
      shape.front_inset_m = random.uniform(0, 0.6) * shape.half.x();
      shape.rear_inset_m = random.uniform(0, 0.6) * shape.half.x();
      shape.side_inset_m = random.uniform(0, 0.6) * shape.half.y();
    }
    const auto place = [&] {
      return Vector3d(random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(-6, 6));
    };
    const SightLine line = towards(place(), place() / 4);
    const auto chord = intersect(shape, line);
    double nearest = 1e9;
    for (double way_m = -20; way_m < 20; way_m += 0.05) {
      nearest = std::min(nearest, outside(shape, line.at(way_m)));
    }
    if (!chord) {
      EXPECT_GT(nearest, -0.02) << "missed a shape of kind " << static_cast<int>(shape.kind);
      continue;
    }
    ++met;
    EXPECT_NEAR(outside(shape, line.at(chord->in_m)), 0, 1e-9);
    EXPECT_NEAR(outside(shape, line.at(chord->out_m)), 0, 1e-9);
    EXPECT_LE(outside(shape, line.at((chord->in_m + chord->out_m) / 2)), 1e-9);
    EXPECT_NEAR(chord->normal.norm(), 1, 1e-9);
    EXPECT_LE(chord->normal.dot(line.direction), 1e-9);
  }
  EXPECT_GT(met, 2000);
}

}  // namespace
}  // namespace terracut::world
