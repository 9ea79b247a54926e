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

namespace terracut::mount {
namespace {

constexpr std::size_t kScoredPoints =
    4000;  ///< Of the points, evenly taken, that judge a candidate.
constexpr int kMaxRefinements = 50;
constexpr std::size_t kLeastInliers = 50;
constexpr double kReachPerRms = 2.0;
constexpr double kLeastReach_m = 0.03;  ///< The sensor's own noise.

/// The plane with `normal` (unit, upwards) at `height` below the origin: normal . p + height = 0.
struct Plane {
  Eigen::Vector3d normal;
  double height_m;
  double above_m(const Eigen::Vector3d& p) const { return normal.dot(p) + height_m; }
};

/// xorshift64*: the same picks on every machine, which standard distributions do not promise.
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

std::vector<Eigen::Vector3d> points_between(std::span<const std::array<float, 3>> points,
                                            const MountEstimateConfig& config) {
  std::vector<Eigen::Vector3d> kept;
  kept.reserve(points.size());
  for (const auto& point : points) {
    const Eigen::Vector3d p(point[0], point[1], point[2]);
    const double range_m = p.head<2>().norm();
    if (range_m >= config.near_m && range_m <= config.far_m && std::isfinite(p.z())) {
      kept.push_back(p);
    }
  }
  return kept;
}

std::optional<Plane> plane_through(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                   const Eigen::Vector3d& c, const MountEstimateConfig& config) {
  Eigen::Vector3d normal = (b - a).cross(c - a);
  const double area = normal.norm();
  if (!(area > 0.5)) return std::nullopt;  // nearly on one line
  normal /= normal.z() < 0 ? -area : area;
  const Plane plane{normal, -normal.dot(a)};
  const bool plausible = normal.z() >= std::cos(config.max_tilt_rad) &&
                         plane.height_m >= config.min_height_m &&
                         plane.height_m <= config.max_height_m;
  return plausible ? std::optional(plane) : std::nullopt;
}

/// The candidate plane that holds most of the points.
std::optional<Plane> search(const std::vector<Eigen::Vector3d>& points,
                            const MountEstimateConfig& config) {
  std::vector<Eigen::Vector3d> judges;
  const std::size_t step = std::max<std::size_t>(1, points.size() / kScoredPoints);
  for (std::size_t i = 0; i < points.size(); i += step) judges.push_back(points[i]);

  Picker pick;
  std::optional<Plane> best;
  std::size_t best_inliers = 0;
  for (int i = 0; i < config.candidates; ++i) {
    const auto& a = points[pick.below(points.size())];
    const auto& b = points[pick.below(points.size())];
    const auto& c = points[pick.below(points.size())];
    const auto plane = plane_through(a, b, c, config);
    if (!plane) continue;
    std::size_t inliers = 0;
    for (const auto& p : judges) inliers += std::abs(plane->above_m(p)) < config.inlier_m ? 1 : 0;
    if (inliers > best_inliers) {
      best_inliers = inliers;
      best = plane;
    }
  }
  return best;
}

struct Fit {
  Plane plane;
  std::size_t inliers;
  double rms_m;
};

/// Least squares z = s . (x, y, 1) over the points within `reach_m` of `plane`.
std::optional<Fit> fit(const std::vector<Eigen::Vector3d>& points, const Plane& plane,
                       double reach_m) {
  Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_side = Eigen::Vector3d::Zero();
  std::size_t inliers = 0;
  double squares = 0;
  for (const auto& p : points) {
    const double above_m = plane.above_m(p);
    if (std::abs(above_m) >= reach_m) continue;
    const Eigen::Vector3d row(p.x(), p.y(), 1.0);
    normal_matrix += row * row.transpose();
    right_side += row * p.z();
    squares += above_m * above_m;
    ++inliers;
  }
  bool solvable = false;
  Eigen::Matrix3d inverse;
  normal_matrix.computeInverseWithCheck(inverse, solvable);
  if (inliers < kLeastInliers || !solvable) return std::nullopt;
  const Eigen::Vector3d s = inverse * right_side;
  const Eigen::Vector3d up(-s.x(), -s.y(), 1.0);
  return Fit{{up.normalized(), -s.z() / up.norm()},
             inliers,
             std::sqrt(squares / static_cast<double>(inliers))};
}

/// Repeats the fit on its own inliers until the plane stands still, reaching less far each time, so
/// that sidewalks and tyres drop out once the road itself is found.
std::optional<Fit> refine(const std::vector<Eigen::Vector3d>& points, Plane plane, double reach_m) {
  std::optional<Fit> result;
  for (int i = 0; i < kMaxRefinements; ++i) {
    result = fit(points, plane, reach_m);
    if (!result) return result;
    const double moved = (result->plane.normal - plane.normal).norm() +
                         std::abs(result->plane.height_m - plane.height_m);
    plane = result->plane;
    const double next_reach_m = std::clamp(kReachPerRms * result->rms_m, kLeastReach_m, reach_m);
    if (moved < 1e-9 && next_reach_m == reach_m) break;
    reach_m = next_reach_m;
  }
  return result;
}

double share_within(const std::vector<Eigen::Vector3d>& points, const Plane& plane,
                    double reach_m) {
  const auto inliers = std::count_if(points.begin(), points.end(), [&](const auto& p) {
    return std::abs(plane.above_m(p)) < reach_m;
  });
  return static_cast<double>(inliers) / static_cast<double>(points.size());
}

/// Third row of rotate_y(pitch) rotate_x(roll) is the ground's normal seen from the sensor.
Mount mount_over(const Plane& plane) {
  return {plane.height_m, std::atan2(plane.normal.y(), plane.normal.z()),
          std::asin(-plane.normal.x())};
}

}  // namespace

Expected<MountEstimate> estimate_mount(std::span<const std::array<float, 3>> points,
                                       const MountEstimateConfig& config) {
  const auto near = points_between(points, config);
  if (near.size() < config.min_points) {
    return fail(ErrorCode::kMalformed,
                fmt::format("mount estimate: expected at least {} points between {:g} and {:g} m, "
                            "found {}; give more frames",
                            config.min_points, config.near_m, config.far_m, near.size()));
  }
  const auto seed = search(near, config);
  const auto found = seed ? refine(near, *seed, config.inlier_m) : std::nullopt;
  const double share = found ? share_within(near, found->plane, config.inlier_m) : 0.0;
  if (share < config.min_inlier_share) {
    return fail(ErrorCode::kMalformed,
                fmt::format("mount estimate: no ground plane {:g} to {:g} m below the sensor holds "
                            "{:.0f} % of the points (best {:.0f} %); record on level, open ground "
                            "or give the mount",
                            config.min_height_m, config.max_height_m, 100 * config.min_inlier_share,
                            100 * share));
  }
  return MountEstimate{mount_over(found->plane), share, found->rms_m, near.size()};
}

}  // namespace terracut::mount
