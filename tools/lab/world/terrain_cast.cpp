// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Casts a line of sight at the ground: it steps as far as the slope of the ground below allows, but
// never over the edge of a strip, where a kerb may stand.
#include <algorithm>
#include <cmath>

#include "terrain.hpp"

namespace terracut::world {
namespace {

constexpr double kShortestStep_m = 0.04;
constexpr double kPastEdge_m =
    0.02;  // How far a step goes beyond an edge, to be in the next strip.
constexpr double kLongestStep_m = 8.0;  // In bends the distance to an edge is known only nearby.
constexpr double kEdgePrecision_m = 1e-6;
constexpr double kBendInPlan = 0.005;  // The most slope that a bend of the road adds.

}  // namespace

/// Returns how fast a line moves away from the centre line, per metre of the line.
double Terrain::outwards(const Zone& zone, const SightLine& line, const Spot& spot) const noexcept {
  const double slope = spot.road.centre_slope;
  return (zone.side == &left_ ? 1.0 : -1.0) * (line.direction.y() - slope * line.direction.x()) /
         std::sqrt(1 + slope * slope);
}

double Terrain::safe_step_m(const Zone& zone, const SightLine& line, const Spot& spot,
                            double clearance_m) const noexcept {
  const double outwards = this->outwards(zone, line, spot);
  const double level = std::hypot(line.direction.x(), line.direction.y());
  const double rise = road_.grade.grade(spot.road.place.s_m) * line.direction.x() +
                      zone.band->strip.slope * outwards;
  const double closing =
      -line.direction.z() + rise +
      (zone.band->unevenness + bend_per_m_ * kLongestStep_m + kBendInPlan) * level;
  double step_m = kLongestStep_m;
  if (closing > 0) step_m = std::min(step_m, std::max(clearance_m / closing, kShortestStep_m));

  const double distance_m = std::abs(spot.road.place.d_m);
  if (outwards > 0) {
    step_m = std::min(step_m, (zone.band->outer_m - distance_m) / outwards + kPastEdge_m);
  } else if (outwards < 0) {
    step_m = std::min(step_m, (distance_m - zone.band->inner_m) / -outwards + kPastEdge_m);
  }
  return std::max(step_m, kPastEdge_m);
}

// The distance from the centre line is nearly linear along a line, so the secant method finds the
// edge in a few rounds. If it stops before the edge, the next step continues from there.
double Terrain::way_of_edge_m(const Zone& here, const SightLine& line, double inside_m,
                              double outside_m) const noexcept {
  const double side = here.side == &left_ ? 1.0 : -1.0;
  const auto distance_m = [&](double way_m) { return side * spot(line, way_m).road.place.d_m; };
  double inside = distance_m(inside_m);
  double outside = distance_m(outside_m);
  const double edge_m = outside >= here.band->outer_m ? here.band->outer_m : here.band->inner_m;
  double way_m = outside_m;
  for (int round = 0; round < 5 && inside != outside; ++round) {
    way_m = inside_m + (outside_m - inside_m) * (edge_m - inside) / (outside - inside);
    const double distance = distance_m(way_m);
    if (std::abs(distance - edge_m) < kEdgePrecision_m) break;
    const bool is_inside = distance >= here.band->inner_m && distance < here.band->outer_m;
    (is_inside ? inside_m : outside_m) = way_m;
    (is_inside ? inside : outside) = distance;
  }
  return std::clamp(way_m + kEdgePrecision_m, inside_m, outside_m);
}

// Finds the ground by regula falsi with the Illinois rule: the clearance is nearly linear between
// two close places.
Hit Terrain::ground_hit(const Zone& here, const SightLine& line, double above_m,
                        double below_m) const noexcept {
  double above = clearance_m(here, spot(line, above_m));
  double below = clearance_m(here, spot(line, below_m));
  double way_m = below_m;
  for (int round = 0; round < 30 && below_m - above_m > 1e-9; ++round) {
    way_m = above_m + (below_m - above_m) * above / (above - below);
    const double clearance = clearance_m(here, spot(line, way_m));
    if (std::abs(clearance) < 1e-9) break;
    if (clearance > 0) {
      above_m = way_m;
      above = clearance;
      below /= 2;
    } else {
      below_m = way_m;
      below = clearance;
      above /= 2;
    }
  }
  const Spot ground = spot(line, way_m);
  return {way_m, normal(here, ground), here.band->strip.truth, material(here, ground)};
}

Hit Terrain::face_hit(const Zone& from, const Zone& to, const SightLine& line,
                      double way_m) const noexcept {
  const double slope = spot(line, way_m).road.centre_slope;
  Eigen::Vector3d normal = Eigen::Vector3d(slope, -1, 0).normalized();
  if (normal.dot(line.direction) > 0) normal = -normal;
  const bool from_pavement = from.band->strip.truth == Truth::kSidewalk;
  const Strip& face = from_pavement ? from.band->strip : to.band->strip;
  return {way_m, normal, face.truth, face.material};
}

std::optional<Hit> Terrain::cast(const SightLine& line, double limit_m) const noexcept {
  const double down = -line.direction.z();
  const double level = std::hypot(line.direction.x(), line.direction.y());
  const auto within = [limit_m](const Hit& hit) {
    return hit.way_m < limit_m ? std::optional(hit) : std::nullopt;
  };
  double way_m = 0;
  Spot at = spot(line, way_m);
  Zone here = zone(at);
  double clearance = clearance_m(here, at);
  if (clearance <= 0) return within(ground_hit(here, line, way_m, way_m));
  while (way_m < limit_m) {
    if (clearance > highest_step_m_ && down + steepest_ * level < 0) return std::nullopt;
    double next_m = way_m + safe_step_m(here, line, at, clearance);
    at = spot(line, next_m);
    const bool leaves = !(zone(at) == here);
    if (leaves) {
      next_m = way_of_edge_m(here, line, way_m, next_m);
      at = spot(line, next_m);
    }
    clearance = clearance_m(here, at);
    if (clearance <= 0) return within(ground_hit(here, line, way_m, next_m));
    if (leaves) {
      const Zone next = zone(at);
      clearance = clearance_m(next, at);
      if (clearance <= 0) return within(face_hit(here, next, line, next_m));
      here = next;
    }
    way_m = next_m;
  }
  return std::nullopt;
}

}  // namespace terracut::world
