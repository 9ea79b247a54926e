// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "calib/beams/beam.hpp"
#include "calib/ruby128/ruby128_calibration.hpp"

namespace terracut::ruby128 {

/// Metres per count of the wire's distance (RS-Ruby user manual).
inline constexpr double kRuby128MetresPerCount = 0.005;
/// The lens sits ahead of the axis of rotation, in the direction of the head
/// (docs/reference/sensors.md).
inline constexpr double kRuby128LensAhead_m = 0.03615;

/// Raw counts to metres and back for one RS-Ruby128, in double: the reference that the packet
/// decoder's float loop is checked against, and what the simulator and the encoder invert.
///
/// With t = the head's azimuth when the channel fires, h = azimuth offset, v = elevation,
/// d = raw * 0.005 m, R = lens offset (docs/reference/sensors.md):
///
///   x =   d cos v cos(t + h) + R cos t
///   y = -(d cos v sin(t + h) + R sin t)
///   z =   d sin v
///
/// All functions: `channel` in [0, 128); `azimuth_rad` is the head's azimuth at the channel's
/// firing, clockwise from straight ahead seen from above, any revolution. Immutable, so any thread may
/// call them; no allocation, no locks; a few trigonometric functions a call (not meant for the
/// per-packet path).
class Ruby128Geometry {
 public:
  explicit Ruby128Geometry(const Ruby128Calibration& calibration) noexcept;

  /// Where a return lies. `raw_counts` is not restricted to whole counts; 0 is not treated as "no
  /// return".
  [[nodiscard]] beams::Point point(int channel, double azimuth_rad,
                                   double raw_counts) const noexcept;

  /// The beam: every point() of the channel lies on it.
  [[nodiscard]] beams::Ray ray(int channel, double azimuth_rad) const noexcept;

  /// The raw counts, not rounded, for which |point()| == range_m to within 1e-9 m; nothing when
  /// they are outside [1, 65535].
  [[nodiscard]] std::optional<double> raw_for_range(int channel, double azimuth_rad,
                                                    double range_m) const noexcept;

  /// The raw counts, not rounded, for which point() lies on the plane through `hit` with `normal`
  /// (any length) to within 1e-9 m; nothing when they are outside [1, 65535] or the beam runs along
  /// the plane.
  [[nodiscard]] std::optional<double> raw_on_plane(int channel, double azimuth_rad,
                                                   const beams::Point& hit,
                                                   const beams::Direction& normal) const noexcept;

 private:
  struct Beam {
    double offset_rad = 0, cos_elevation = 1, sin_elevation = 0;
  };
  [[nodiscard]] const Beam& beam(int channel) const noexcept {
    return beams_[static_cast<std::size_t>(channel)];
  }

  std::array<Beam, kRuby128Lasers> beams_{};
};

}  // namespace terracut::ruby128
