// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "cross_section.hpp"
#include "hit.hpp"
#include "road.hpp"

namespace terracut::world {

/// The ground of the simulated world: one height for every place, smooth except for the vertical
/// faces between strips (kerbs). World frame: x along the road at s = 0, y left, z up, metres.
///
/// Immutable; any thread may use it.
class Terrain {
 public:
  Terrain(Road road, std::uint64_t seed);

  [[nodiscard]] const Road& road() const noexcept { return road_; }

  [[nodiscard]] double height_m(double x_m, double y_m) const noexcept;
  [[nodiscard]] const Strip& strip(double x_m, double y_m) const noexcept;

  /// Returns the first intersection of a line of sight with the ground within `limit_m` of its
  /// origin, which must be above the ground; nothing if there is none. Exact to a micrometre on
  /// smooth ground; a bump that the line touches for less than a few centimetres may be missed.
  [[nodiscard]] std::optional<Hit> cast(const SightLine& line, double limit_m) const noexcept;

 private:
  /// The side of the road on which a place lies, and its band.
  struct Zone {
    const CrossSection* side = nullptr;
    const CrossSection::Band* band = nullptr;
    bool operator==(const Zone&) const = default;
  };

  /// A place on a line of sight.
  struct Spot {
    double x_m = 0, y_m = 0, z_m = 0;
    Road::Location road;
  };

  [[nodiscard]] Spot spot(double x_m, double y_m, double z_m = 0) const noexcept {
    return {x_m, y_m, z_m, road_.locate(x_m, y_m)};
  }
  [[nodiscard]] Spot spot(const SightLine& line, double way_m) const noexcept {
    const Eigen::Vector3d at = line.at(way_m);
    return spot(at.x(), at.y(), at.z());
  }
  [[nodiscard]] Zone zone(const Spot& spot) const noexcept;
  /// Returns the height that the zone's band would have at `spot`.
  [[nodiscard]] double height_m(const Zone& zone, const Spot& spot) const noexcept;
  [[nodiscard]] double clearance_m(const Zone& zone, const Spot& spot) const noexcept {
    return spot.z_m - height_m(zone, spot);
  }
  [[nodiscard]] Eigen::Vector3d normal(const Zone& zone, const Spot& spot) const noexcept;
  [[nodiscard]] Material material(const Zone& zone, const Spot& spot) const noexcept;

  [[nodiscard]] double outwards(const Zone& zone, const SightLine& line,
                                const Spot& spot) const noexcept;
  [[nodiscard]] double safe_step_m(const Zone& zone, const SightLine& line, const Spot& spot,
                                   double clearance_m) const noexcept;
  [[nodiscard]] double way_of_edge_m(const Zone& zone, const SightLine& line, double inside_m,
                                     double outside_m) const noexcept;
  [[nodiscard]] Hit ground_hit(const Zone& zone, const SightLine& line, double above_m,
                               double below_m) const noexcept;
  [[nodiscard]] Hit face_hit(const Zone& from, const Zone& to, const SightLine& line,
                             double way_m) const noexcept;

  Road road_;
  std::uint64_t seed_;
  CrossSection left_, right_;
  double bend_per_m_;
  double steepest_;
  double highest_step_m_;
};

/// Returns the pose of an object with four wheels or a long base on the ground: its origin is on
/// the ground in the middle, x points along its heading, z away from the ground.
[[nodiscard]] Eigen::Isometry3d stand_on(const Terrain& terrain, double x_m, double y_m,
                                         double heading_rad, double half_base_m,
                                         double half_track_m);

}  // namespace terracut::world
