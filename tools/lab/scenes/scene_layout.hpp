// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "scene.hpp"
#include "tools/lab/world/random.hpp"

namespace terracut::scenes {

/// Fills a scene with things in rows along the road.
class SceneLayout {
 public:
  /// Things are placed up to this far from the vehicle: just beyond the sensor's range.
  static constexpr double kSight_m = 135.0;

  SceneLayout(Scene& scene, const SceneExtent& extent) noexcept : scene_(scene), extent_(extent) {}

  /// Calls place(random, s_m) for every multiple s_m of `pitch_m` from which a thing that moves
  /// with `along_mps` comes into sight at any time. The thing depends only on the seed, on `row` (a
  /// different number for each use) and on s_m.
  template <class Place>
  void row(std::uint64_t row, double pitch_m, double along_mps, Place&& place) {
    const double gained_m = (scene_.ego_speed_mps - along_mps) * extent_.duration_s;
    const double from_m = (gained_m < 0 ? gained_m : 0) - kSight_m;
    const double to_m = (gained_m > 0 ? gained_m : 0) + kSight_m;
    for (auto slot = static_cast<std::int64_t>(std::ceil(from_m / pitch_m));
         static_cast<double>(slot) * pitch_m <= to_m; ++slot) {
      world::Random random(
          world::mix_keys(world::mix_keys(extent_.seed, row), static_cast<std::uint64_t>(slot)));
      place(random, static_cast<double>(slot) * pitch_m);
    }
  }

  void add(world::SceneObject object, const world::RoadPoint& place, double heading_rad = 0,
           double along_mps = 0) {
    object.place = place;
    object.heading_rad = heading_rad;
    object.along_mps = along_mps;
    object.key = world::mix_keys(std::bit_cast<std::uint64_t>(place.s_m),
                                 std::bit_cast<std::uint64_t>(place.d_m));
    scene_.objects.push_back(std::move(object));
  }

  /// Adds a long thing that lies along the road and follows its slope.
  void add_along(world::SceneObject object, const world::RoadPoint& place, double length_m) {
    object.stance = world::Stance::kOnWheels;
    object.half_base_m = length_m / 2;
    object.half_track_m = 0.2;
    add(std::move(object), place);
  }

 private:
  Scene& scene_;
  SceneExtent extent_;
};

/// Half a revolution: the heading of a thing that faces against the direction of the road.
inline constexpr double kAgainst_rad = std::numbers::pi;

}  // namespace terracut::scenes
