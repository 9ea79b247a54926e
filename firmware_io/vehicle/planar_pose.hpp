// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

namespace terracut::vehicle {

/// A pose in the ground plane: p_outer = R p_inner + t, x forward, y left, metres.
struct PlanarPose {
  double x_m = 0, y_m = 0;
  double cosine = 1, sine = 0;  ///< The heading.
};

[[nodiscard]] constexpr PlanarPose operator*(const PlanarPose& a, const PlanarPose& b) noexcept {
  return {a.x_m + a.cosine * b.x_m - a.sine * b.y_m, a.y_m + a.sine * b.x_m + a.cosine * b.y_m,
          a.cosine * b.cosine - a.sine * b.sine, a.sine * b.cosine + a.cosine * b.sine};
}

[[nodiscard]] constexpr PlanarPose inverse(const PlanarPose& a) noexcept {
  return {-a.cosine * a.x_m - a.sine * a.y_m, a.sine * a.x_m - a.cosine * a.y_m, a.cosine, -a.sine};
}

/// Returns where a vehicle is after `seconds` (before, if negative) of constant speed and yaw rate,
/// relative to its start: an arc, or a line if it drives straight. State equations of the CTRV
/// model as in R. Schubert, E. Richter, G. Wanielik, "Comparison and evaluation of advanced motion
/// models for vehicle tracking" (FUSION 2008), with sine and cosine as series:
///
///   x = v t sin(a) / a,   y = v t (1 - cos(a)) / a,   a = yaw rate * t
///
/// so that a = 0 is no special case and every machine gets the same bits. Error below 1e-11 of
/// the path for rotations up to kLongestArc_rad a series; longer ones are composed of several.
[[nodiscard]] constexpr PlanarPose after_constant_motion(double speed_mps, double yaw_rate_radps,
                                                         double seconds) noexcept {
  constexpr double kLongestArc_rad = 0.25;
  const double rotated = yaw_rate_radps * seconds;
  const int arcs = 1 + static_cast<int>((rotated < 0 ? -rotated : rotated) / kLongestArc_rad);
  const double a = rotated / arcs, way_m = speed_mps * seconds / arcs;
  const double aa = a * a;
  const double sine_by_a = 1 - aa / 6 * (1 - aa / 20 * (1 - aa / 42 * (1 - aa / 72)));
  const double versine_by_a = a / 2 * (1 - aa / 12 * (1 - aa / 30 * (1 - aa / 56)));
  const PlanarPose arc{way_m * sine_by_a, way_m * versine_by_a, 1 - a * versine_by_a,
                       a * sine_by_a};
  PlanarPose pose = arc;
  for (int i = 1; i < arcs; ++i) pose = pose * arc;
  return pose;
}

}  // namespace terracut::vehicle
