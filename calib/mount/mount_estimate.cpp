// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/mount/mount_estimate.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "rt/vector_clones.hpp"

namespace terracut::mount {
namespace {

constexpr double kNearest_m = 3.0;  ///< Nearer points may be the vehicle itself.
constexpr double kLowest_m = 0.2,
                 kHighest_m = 6.0;      ///< The search covers all heights that a user may state.
constexpr double kSteepest_rad = 0.26;  ///< 15 degrees.
constexpr double kReach_m = 0.10;       ///< Half thickness of the ground in the search.
constexpr double kLeastShare = 0.2;     ///< Least share of points within that thickness.
/// The least number of points in the strip; an RS-Ruby128 3 m above the ground sees about 250.
constexpr std::size_t kLeastPoints = 150;
/// Number of random planes tried. This many find a plane that holds 20 % of the points in 98 % of
/// frames.
constexpr int kCandidates = 500;
constexpr int kMaxRefinements = 50;
constexpr std::size_t kLeastInliers = 50;
constexpr double kReachPerRms = 2.0;
constexpr double kLeastReach_m = 0.03;  ///< The sensor's own noise.

/// Points are thinned to kMostInCell a cell: ground counts by area, not by how densely it is seen.
constexpr double kCell_m = 0.5;
constexpr int kMostInCell = 8;

/// The length along the road over which unevenness correlates: all points of a patch this long
/// share one error.
constexpr double kPatch_m = 3.0;

constexpr double kUsualUnevenness_m = 0.02;

/// The ground in the sensor frame: z = slope_x x + slope_y y + offset_m + bend_per_m x^2.
struct Ground {
  Eigen::Vector4d terms = Eigen::Vector4d::Zero();  ///< slope_x, slope_y, offset, bend

  static Eigen::Vector4d row(const Eigen::Vector3d& p) { return {p.x(), p.y(), 1, p.x() * p.x()}; }
  /// Returns the plane that touches the ground at x.
  Ground tangent_at(double x_m) const {
    return {{terms[0] + 2 * terms[3] * x_m, terms[1], terms[2] - terms[3] * x_m * x_m, 0}};
  }
  // The next two functions are for ground without a bend: they return its unit normal, and how far
  // it lies below the sensor.
  Eigen::Vector3d up() const { return Eigen::Vector3d(-terms[0], -terms[1], 1).normalized(); }
  double height_m() const { return -terms[2] * up().z(); }
  double above_m(const Eigen::Vector3d& p) const { return (p.z() - row(p).dot(terms)) * up().z(); }
};

/// Picks random points by xorshift64*: the same on every machine, unlike standard distributions.
class Picker {
 public:
  std::size_t below(std::size_t count) {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return static_cast<std::size_t>((state_ * 0x2545F4914F6CDD1DULL) >> 16) % count;
  }

 private:
  std::uint64_t state_ = 0x9E3779B97F4A7C15ULL;
};

std::vector<Eigen::Vector3d> points_in_reach(std::span<const std::array<float, 3>> points,
                                             double farthest_m) {
  std::vector<Eigen::Vector3d> kept;
  kept.reserve(points.size());
  for (const auto& point : points) {
    const Eigen::Vector3d p(point[0], point[1], point[2]);
    const double range_m = p.head<2>().norm();
    if (range_m >= kNearest_m && range_m <= farthest_m && std::isfinite(p.z())) {
      kept.push_back(p);
    }
  }
  return kept;
}

/// Numbers the square cells of width `cell_m`; a point gives the number of its cell.
class CellOf {
 public:
  explicit CellOf(double cell_m)
      : cell_m_(cell_m), across_(1 + static_cast<std::size_t>(2 * kFarStrip.farthest_m / cell_m)) {}

  std::size_t cells() const { return across_ * across_; }
  std::size_t operator()(const Eigen::Vector3d& p) const {
    return along(p.x()) * across_ + along(p.y());
  }

 private:
  std::size_t along(double at_m) const {
    return static_cast<std::size_t>((at_m + kFarStrip.farthest_m) / cell_m_);
  }
  double cell_m_;
  std::size_t across_;
};

/// Thins the points: keeps all points of sparse cells and evenly spaced points of crowded cells.
std::vector<Eigen::Vector3d> evened_out(const std::vector<Eigen::Vector3d>& points) {
  const CellOf cell_of(kCell_m);
  std::vector<int> count(cell_of.cells()), seen(cell_of.cells());
  for (const auto& p : points) ++count[cell_of(p)];
  std::vector<Eigen::Vector3d> kept;
  for (const auto& p : points) {
    const std::size_t cell = cell_of(p);
    const int step = (count[cell] + kMostInCell - 1) / kMostInCell;
    if (seen[cell]++ % step == 0) kept.push_back(p);
  }
  return kept;
}

std::optional<Ground> plane_through(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c) {
  Eigen::Vector3d normal = (b - a).cross(c - a);
  const double area = normal.norm();
  if (!(area > 0.5)) return std::nullopt;  // the points lie nearly on one line
  normal /= normal.z() < 0 ? -area : area;
  const double height_m = -normal.dot(a);
  const bool plausible =
      normal.z() >= std::cos(kSteepest_rad) && height_m >= kLowest_m && height_m <= kHighest_m;
  if (!plausible) return std::nullopt;
  return Ground{Eigen::Vector4d(-normal.x(), -normal.y(), -height_m, 0) / normal.z()};
}

/// The points, one array per coordinate, so that SIMD tests several against a plane at once: this
/// takes most of an estimate's time.
struct Coordinates {
  std::vector<double> x_m, y_m, z_m;

  explicit Coordinates(const std::vector<Eigen::Vector3d>& points) {
    for (const auto& p : points) {
      x_m.push_back(p.x());
      y_m.push_back(p.y());
      z_m.push_back(p.z());
    }
  }
};

/// A plane without a bend.
struct Plane {
  double slope_x, slope_y, offset_m, up_z;
};

/// Returns how many of the points lie on `plane`.
TERRACUT_VECTOR_CLONES std::size_t count_on(const Plane& plane, const double* __restrict x_m,
                                            const double* __restrict y_m,
                                            const double* __restrict z_m, std::size_t count) {
  const double slope_x = plane.slope_x, slope_y = plane.slope_y, offset_m = plane.offset_m,
               up_z = plane.up_z;
  std::size_t on_it = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double ground_m = (x_m[i] * slope_x + offset_m) + y_m[i] * slope_y;
    on_it += std::fabs((z_m[i] - ground_m) * up_z) < kReach_m ? 1 : 0;
  }
  return on_it;
}

/// Returns how many of the points lie on `plane`. Stops counting once they cannot exceed `others`.
std::size_t inliers_of(const Ground& plane, const Coordinates& points, std::size_t others) {
  constexpr std::size_t kAtOnce = 256;
  const Plane flat{.slope_x = plane.terms[0],
                   .slope_y = plane.terms[1],
                   .offset_m = plane.terms[2],
                   .up_z = plane.up().z()};
  const std::size_t count = points.x_m.size();
  std::size_t inliers = 0;
  for (std::size_t begin = 0; begin < count && inliers + (count - begin) > others;
       begin += kAtOnce) {
    inliers += count_on(flat, &points.x_m[begin], &points.y_m[begin], &points.z_m[begin],
                        std::min(count - begin, kAtOnce));
  }
  return inliers;
}

/// Returns the candidate plane that holds the most points.
std::optional<Ground> search(const std::vector<Eigen::Vector3d>& points) {
  const Coordinates coordinates(points);
  Picker pick;
  std::optional<Ground> best;
  std::size_t best_inliers = 0;
  for (int i = 0; i < kCandidates; ++i) {
    const auto& a = points[pick.below(points.size())];
    const auto& b = points[pick.below(points.size())];
    const auto& c = points[pick.below(points.size())];
    const auto plane = plane_through(a, b, c);
    if (!plane) continue;
    const std::size_t inliers = inliers_of(*plane, coordinates, best_inliers);
    if (inliers > best_inliers) {
      best_inliers = inliers;
      best = plane;
    }
  }
  return best;
}

struct Fit {
  Ground ground;
  double rms_m = 0;
  Eigen::Vector4d deviations;  ///< Standard deviations of the ground's terms.
};

/// Fits the ground to the points within `reach_m` of `ground` by least squares. Each patch of
/// points counts as one measurement.
std::optional<Fit> fit(const std::vector<Eigen::Vector3d>& points, const Ground& ground,
                       double reach_m, const CellOf& patch_of, const Strip& strip) {
  Eigen::Matrix4d normal_matrix = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right_side = Eigen::Vector4d::Zero();
  std::vector<bool> has_points(patch_of.cells());
  std::size_t inliers = 0;
  double squares = 0;
  for (const auto& p : points) {
    const double above_m = ground.above_m(p);
    if (std::abs(above_m) >= reach_m) continue;
    const Eigen::Vector4d row = Ground::row(p);
    normal_matrix += row * row.transpose();
    right_side += row * p.z();
    squares += above_m * above_m;
    has_points[patch_of(p)] = true;
    ++inliers;
  }
  if (inliers < kLeastInliers) return std::nullopt;
  const auto patches = std::count(has_points.begin(), has_points.end(), true);
  const double points_a_patch = static_cast<double>(inliers) / static_cast<double>(patches);
  // Where only one ring meets the ground, bend and height cannot be told apart; this prior keeps
  // both finite, and the reported uncertainty grows.
  const double usual = kUsualUnevenness_m / strip.usual_bend_per_m;
  normal_matrix(3, 3) += points_a_patch * usual * usual;
  bool solvable = false;
  Eigen::Matrix4d inverse;
  normal_matrix.computeInverseWithCheck(inverse, solvable);
  if (!solvable) return std::nullopt;
  const double rms_m = std::sqrt(squares / static_cast<double>(inliers));
  return Fit{{inverse * right_side},
             rms_m,
             std::max(rms_m, kUsualUnevenness_m) *
                 (points_a_patch * inverse.diagonal()).cwiseMax(0).cwiseSqrt()};
}

/// Repeats the fit on its own inliers until the ground no longer moves, then with a smaller reach
/// each time: sidewalks and tyres drop out once the road itself is found.
std::optional<Fit> refine(const std::vector<Eigen::Vector3d>& points, Ground ground,
                          const Strip& strip) {
  const CellOf patch_of(kPatch_m);
  double reach_m = kReach_m;
  std::optional<Fit> result;
  for (int i = 0; i < kMaxRefinements; ++i) {
    result = fit(points, ground, reach_m, patch_of, strip);
    if (!result) return result;
    const double moved = (result->ground.terms - ground.terms).norm();
    ground = result->ground;
    const double next_reach_m = std::clamp(kReachPerRms * result->rms_m, kLeastReach_m, reach_m);
    if (moved < 1e-9 && next_reach_m == reach_m) break;
    reach_m = next_reach_m;
  }
  return result;
}

double share_within_reach(const std::vector<Eigen::Vector3d>& points, const Ground& ground) {
  const auto inliers = std::count_if(points.begin(), points.end(), [&](const auto& p) {
    return std::abs(ground.above_m(p)) < kReach_m;
  });
  return static_cast<double>(inliers) / static_cast<double>(points.size());
}

/// Returns the mount over `ground`. The ground's normal in the sensor frame is the third row of
/// rotate_y(pitch) rotate_x(roll). A tilted sensor's z axis does not point straight down, so the
/// height is measured along the normal.
Mount mount_over(const Ground& ground) {
  const Ground near = ground.tangent_at(0);
  const Ground below = ground.tangent_at(-near.height_m() * near.up().x());
  const Eigen::Vector3d up = below.up();
  return {below.height_m(), std::atan2(up.y(), up.z()), std::asin(-up.x())};
}

}  // namespace

Expected<MountEstimate> estimate_mount(std::span<const std::array<float, 3>> points,
                                       const Strip& strip) {
  const auto near = points_in_reach(points, strip.farthest_m);
  if (near.size() < kLeastPoints) {
    return fail(ErrorCode::kMalformed,
                fmt::format("of the ground {:g} to {:g} m before and behind the sensor {} points "
                            "are seen, {} are needed",
                            kNearest_m, strip.farthest_m, near.size(), kLeastPoints));
  }
  const auto even = evened_out(near);
  const auto seed = search(even);
  const auto found = seed ? refine(even, *seed, strip) : std::optional<Fit>();
  // The least squares fit may end at a plane above the sensor.
  const bool is_below = found && mount_over(found->ground).height_m > 0;
  const double share = is_below ? share_within_reach(even, found->ground) : 0.0;
  if (share < kLeastShare) {
    return fail(
        ErrorCode::kMalformed,
        fmt::format("no ground plane {:g} to {:g} m below the sensor holds {:.0f} % of what "
                    "is seen before and behind it (best {:.0f} %)",
                    kLowest_m, kHighest_m, 100 * kLeastShare, 100 * share));
  }
  // The tilts are small, so slopes equal angles, and the height is minus the offset.
  const Eigen::Vector4d& deviation = found->deviations;
  return MountEstimate{mount_over(found->ground),
                       {deviation[2], deviation[1], deviation[0]},
                       found->ground.terms[3]};
}

}  // namespace terracut::mount
