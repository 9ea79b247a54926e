// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace terracut::world {
namespace {

using Eigen::Vector3d;

constexpr double kForever = std::numeric_limits<double>::infinity();

/// Clips a chord to one side of a plane; false if nothing is left.
bool clip(Chord& chord, const Vector3d& from, const Vector3d& direction, const Vector3d& normal,
          double plane) noexcept {
  const double closing = normal.dot(direction);
  const double inside = plane - normal.dot(from);  // > 0 inside
  if (closing == 0) return inside >= 0;
  const double way_m = inside / closing;
  if (closing > 0) {
    chord.out_m = std::min(chord.out_m, way_m);
  } else if (way_m > chord.in_m) {
    chord.in_m = way_m;
    chord.normal = normal;
  }
  return chord.in_m <= chord.out_m;
}

std::optional<Chord> clip_box(const Shape& shape, const Vector3d& from,
                              const Vector3d& direction) noexcept {
  Chord chord{-kForever, kForever, Vector3d::UnitZ()};
  const Vector3d& half = shape.half;
  const double height = 2 * half.z();
  // Clips at a face that leans inwards: from the distance `foot` at its foot, by `inset` up to its
  // top.
  const auto leaning = [&](const Vector3d& outwards, double foot, double inset) {
    const Vector3d normal = height * outwards + inset * Vector3d::UnitZ();
    return clip(chord, from, direction, normal, height * foot - inset * half.z());
  };
  if (!clip(chord, from, direction, Vector3d::UnitZ(), half.z()) ||
      !clip(chord, from, direction, -Vector3d::UnitZ(), half.z()) ||
      !leaning(Vector3d::UnitX(), half.x(), shape.front_inset_m) ||
      !leaning(-Vector3d::UnitX(), half.x(), shape.rear_inset_m) ||
      !leaning(Vector3d::UnitY(), half.y(), shape.side_inset_m) ||
      !leaning(-Vector3d::UnitY(), half.y(), shape.side_inset_m)) {
    return std::nullopt;
  }
  chord.normal.normalize();
  return chord;
}

/// Clips to a cylinder with flat ends around the coordinate axis number `axis`.
std::optional<Chord> clip_cylinder(const Shape& shape, const Vector3d& from,
                                   const Vector3d& direction, int axis) noexcept {
  const Vector3d along = Vector3d::Unit(axis);
  const Vector3d flat_from = from - from[axis] * along;
  const Vector3d flat_direction = direction - direction[axis] * along;
  const double a = flat_direction.squaredNorm();
  const double b = flat_from.dot(flat_direction);
  const double c = flat_from.squaredNorm() - shape.half.x() * shape.half.x();
  Chord chord{-kForever, kForever, along};
  if (a > 0) {
    const double root = b * b - a * c;
    if (root < 0) return std::nullopt;
    chord.in_m = (-b - std::sqrt(root)) / a;
    chord.out_m = (-b + std::sqrt(root)) / a;
    chord.normal = (flat_from + chord.in_m * flat_direction) / shape.half.x();
  } else if (c > 0) {
    return std::nullopt;
  }
  if (!clip(chord, from, direction, along, shape.half[axis]) ||
      !clip(chord, from, direction, -along, shape.half[axis])) {
    return std::nullopt;
  }
  return chord;
}

std::optional<Chord> clip_ellipsoid(const Shape& shape, const Vector3d& from,
                                    const Vector3d& direction) noexcept {
  const Vector3d unit_from = from.cwiseQuotient(shape.half);
  const Vector3d unit_direction = direction.cwiseQuotient(shape.half);
  const double a = unit_direction.squaredNorm();
  const double b = unit_from.dot(unit_direction);
  const double root = b * b - a * (unit_from.squaredNorm() - 1);
  if (root < 0) return std::nullopt;
  Chord chord{(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a, Vector3d::UnitZ()};
  chord.normal = (unit_from + chord.in_m * unit_direction).cwiseQuotient(shape.half).normalized();
  return chord;
}

}  // namespace

std::optional<Chord> intersect(const Shape& shape, const SightLine& line) noexcept {
  const Vector3d from = line.origin - shape.centre;
  switch (shape.kind) {
    case ShapeKind::kBox:
      return clip_box(shape, from, line.direction);
    case ShapeKind::kPost:
      return clip_cylinder(shape, from, line.direction, 2);
    case ShapeKind::kWheel:
      return clip_cylinder(shape, from, line.direction, 1);
    case ShapeKind::kEllipsoid:
      return clip_ellipsoid(shape, from, line.direction);
  }
  return std::nullopt;
}

}  // namespace terracut::world
