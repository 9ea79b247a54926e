// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/encode/motion_compensation.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace terracut::encode {
namespace {

using Vector = std::array<double, 3>;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Applies exp(-seconds * twist) to p, to second order in the angle (under 0.1 rad in half a
/// revolution).
Vector moved_back(const SensorTwist& twist, double seconds, const Vector& p) {
  Vector w = twist.angular_velocity_rad_s, v = twist.velocity_m_s;
  for (std::size_t i = 0; i < 3; ++i) {
    w[i] *= -seconds;
    v[i] *= -seconds;
  }
  const Vector wp = cross(w, p), wwp = cross(w, wp), wv = cross(w, v);
  Vector q{};
  for (std::size_t i = 0; i < 3; ++i) q[i] = p[i] + wp[i] + wwp[i] / 2 + v[i] + wv[i] / 2;
  return q;
}

/// Returns the azimuth as a share of a revolution, clockwise, nearest to `near`: the value jumps by
/// 1 straight behind the sensor.
double share_of_frame(const Vector& p, double near) {
  const double share = std::atan2(-p[1], p[0]) / (2 * std::numbers::pi);
  return share - std::floor(share - near + 0.5);
}

}  // namespace

void undo_motion_compensation(const SensorTwist& twist,
                              std::span<scan::ScanPoint> points) noexcept {
  constexpr int kCorrections = 4;  // each is less than a fifth (v t / r) of the one before
  for (scan::ScanPoint& point : points) {
    if (!scan::is_place(point)) continue;
    const Vector in_file{point.x_m, point.y_m, point.z_m};
    Vector p = in_file;
    double share = share_of_frame(p, 0.0);
    for (int i = 0; i < kCorrections; ++i) {
      p = moved_back(twist, share * twist.frame_duration_s, in_file);
      share = share_of_frame(p, share);
    }
    point.x_m = static_cast<float>(p[0]);
    point.y_m = static_cast<float>(p[1]);
    point.z_m = static_cast<float>(p[2]);
  }
}

}  // namespace terracut::encode
