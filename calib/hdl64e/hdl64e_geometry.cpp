// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hdl64e/hdl64e_geometry.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace terracut::hdl64e {
namespace {

constexpr double kTolerance_m = 1e-9;
/// The largest number of steps that solve() takes. The functions it solves are nearly linear in
/// each of their pieces, so that it typically takes three.
constexpr int kMaxSecantSteps = 30;

/// Returns the root of `distance_m(raw)`, searched from `raw`. The slope of the function is about
/// one distance resolution a count.
template <class Function>
std::optional<double> solve(const Function& distance_m, double raw) noexcept {
  double previous = raw - 1.0;
  double f_previous = distance_m(previous);
  double f = distance_m(raw);
  for (int step = 0; step < kMaxSecantSteps && std::abs(f) > kTolerance_m; ++step) {
    const double slope = (f - f_previous) / (raw - previous);
    if (slope == 0.0 || !std::isfinite(slope)) return std::nullopt;
    previous = raw;
    f_previous = f;
    raw -= f / slope;
    f = distance_m(raw);
  }
  const bool found = std::abs(f) <= kTolerance_m && raw >= 1.0 && raw <= beams::kMaxRawCounts;
  return found ? std::optional(raw) : std::nullopt;
}

double square(double v) noexcept {
  return v * v;
}

double norm(const beams::Point& p) noexcept {
  return std::sqrt(square(p.x_m) + square(p.y_m) + square(p.z_m));
}

}  // namespace

Hdl64eGeometry::Hdl64eGeometry(const Hdl64eCalibration& calibration, GeometryModel model) noexcept
    : model_(model),
      resolution_m_(calibration.distance_resolution_m),
      interpolation_end_m_(
          model == GeometryModel::kManual ? kFarPoint_m : std::numeric_limits<double>::infinity()) {
  const bool across_beam = model == GeometryModel::kRosLike;
  for (std::size_t i = 0; i < beams_.size(); ++i) {
    const Hdl64eLaser& laser = calibration.lasers[i];
    Beam& beam = beams_[i];
    beam.rot_rad = laser.rot_correction_rad;
    beam.cos_vert = std::cos(laser.vert_correction_rad);
    beam.sin_vert = std::sin(laser.vert_correction_rad);
    beam.far_m = laser.dist_correction_m;
    beam.near_x_m = laser.dist_correction_x_m;
    beam.near_y_m = laser.dist_correction_y_m;
    beam.slope_x = (beam.far_m - beam.near_x_m) / (kFarPoint_m - kNearPointX_m);
    beam.slope_y = (beam.far_m - beam.near_y_m) / (kFarPoint_m - kNearPointY_m);
    beam.two_point = laser.two_point;
    beam.horiz_m = laser.horiz_offset_m;
    beam.xy_start_m = across_beam ? -laser.vert_offset_m * beam.sin_vert : 0.0;
    beam.z_start_m = across_beam ? laser.vert_offset_m * beam.cos_vert : laser.vert_offset_m;
  }
}

beams::Point Hdl64eGeometry::point(const Beam& beam, double sin_a, double cos_a,
                                   double raw_counts) const noexcept {
  const double measured_m = raw_counts * resolution_m_;
  double along_x_m = measured_m + beam.far_m;
  double along_y_m = along_x_m;
  if (beam.two_point) {
    const double xy = along_x_m * beam.cos_vert + beam.xy_start_m;
    const double right = std::abs(xy * sin_a - beam.horiz_m * cos_a);
    const double forward = std::abs(xy * cos_a + beam.horiz_m * sin_a);
    along_x_m = measured_m + beam.near_x_m +
                beam.slope_x * (std::min(right, interpolation_end_m_) - kNearPointX_m);
    along_y_m = measured_m + beam.near_y_m +
                beam.slope_y * (std::min(forward, interpolation_end_m_) - kNearPointY_m);
  }
  const double right_m =
      (along_x_m * beam.cos_vert + beam.xy_start_m) * sin_a - beam.horiz_m * cos_a;
  const double forward_m =
      (along_y_m * beam.cos_vert + beam.xy_start_m) * cos_a + beam.horiz_m * sin_a;
  return {forward_m, -right_m, along_y_m * beam.sin_vert + beam.z_start_m};
}

beams::Point Hdl64eGeometry::point(int laser, double azimuth_rad,
                                   double raw_counts) const noexcept {
  const Beam& b = beam(laser);
  const double a = azimuth_rad - b.rot_rad;
  return point(b, std::sin(a), std::cos(a), raw_counts);
}

beams::Ray Hdl64eGeometry::ray(int laser, double azimuth_rad) const noexcept {
  const Beam& b = beam(laser);
  const double a = azimuth_rad - b.rot_rad;
  const double sin_a = std::sin(a), cos_a = std::cos(a);
  return {{b.xy_start_m * cos_a + b.horiz_m * sin_a, b.horiz_m * cos_a - b.xy_start_m * sin_a,
           b.z_start_m},
          {b.cos_vert * cos_a, -b.cos_vert * sin_a, b.sin_vert}};
}

std::optional<double> Hdl64eGeometry::raw_for_range(int laser, double azimuth_rad,
                                                    double range_m) const noexcept {
  const Beam& b = beam(laser);
  const double a = azimuth_rad - b.rot_rad;
  const double sin_a = std::sin(a), cos_a = std::cos(a);
  return solve([&](double raw) { return norm(point(b, sin_a, cos_a, raw)) - range_m; },
               (range_m - b.far_m) / resolution_m_);
}

std::optional<double> Hdl64eGeometry::raw_on_plane(int laser, double azimuth_rad,
                                                   const beams::Point& hit,
                                                   const beams::Direction& normal) const noexcept {
  const Beam& b = beam(laser);
  const double a = azimuth_rad - b.rot_rad;
  const double sin_a = std::sin(a), cos_a = std::cos(a);
  const double length = std::sqrt(square(normal.x) + square(normal.y) + square(normal.z));
  const auto off_plane_m = [&](double raw) {
    const beams::Point p = point(b, sin_a, cos_a, raw);
    return ((p.x_m - hit.x_m) * normal.x + (p.y_m - hit.y_m) * normal.y +
            (p.z_m - hit.z_m) * normal.z) /
           length;
  };
  return solve(off_plane_m, (norm(hit) - b.far_m) / resolution_m_);
}

}  // namespace terracut::hdl64e
