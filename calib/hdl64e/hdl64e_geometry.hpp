// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "calib/beams/beam.hpp"
#include "calib/hdl64e/hdl64e_calibration.hpp"

namespace terracut::hdl64e {

/// How the laser's offsets enter the coordinates (docs/reference/sensors.md).
enum class GeometryModel : std::uint8_t {
  kManual,   ///< The maker's sample code: vertical offset straight up, two-point up to 25.04 m.
  kRosLike,  ///< As ROS drivers do: vertical offset across the beam, two-point extrapolated.
};

/// The distances that two-point calibration measures (HDL-64E S3 manual Rev K, appendix F).
inline constexpr double kFarPoint_m = 25.04;
inline constexpr double kNearPointX_m = 2.40;
inline constexpr double kNearPointY_m = 1.93;

/// Raw counts to metres and back for one HDL-64E, in double: the reference that the packet
/// decoder's float loop is checked against, and what the simulator and the encoder invert.
///
/// With t = azimuth, rho / omega = the laser's rotational / vertical correction, a = t - rho,
/// d1 = raw * resolution, D / DX / DY = far / X / Y distance correction, h / v = horizontal /
/// vertical offset (HDL-64E S3 manual Rev K, appendix F, p. 43; right r, forward f, up z):
///
///   xy = (d1 + D) cos omega [- v sin omega]        [kRosLike only]
///   rr = |xy sin a - h cos a|     ff = |xy cos a + h sin a|
///   CX = DX + (D - DX) (rr - 2.40) / (25.04 - 2.40)
///   CY = DY + (D - DY) (ff - 1.93) / (25.04 - 1.93)
///   r  = ((d1 + CX) cos omega [- v sin omega]) sin a - h cos a
///   f  = ((d1 + CY) cos omega [- v sin omega]) cos a + h sin a
///   z  = (d1 + CY) sin omega + v [* cos omega]     x = f, y = -r
///
/// CX = CY = D for lasers without two_point. The manual's text restricts the interpolation to
/// "nearer than 25 m only"; kManual takes this per axis (rr and ff end at 25.04 m, where CX and CY
/// have become D), which keeps a point's range continuous and increasing in its raw distance.
/// kRosLike extrapolates.
///
/// All functions: `laser` in [0, 64); `azimuth_rad` is the head's azimuth at the laser's firing,
/// clockwise from straight ahead seen from above, any revolution. Immutable, so any thread may call
/// them; no allocation, no locks; a few trigonometric functions a call (not meant for the
/// per-packet path).
class Hdl64eGeometry {
 public:
  explicit Hdl64eGeometry(const Hdl64eCalibration& calibration,
                          GeometryModel model = GeometryModel::kManual) noexcept;

  [[nodiscard]] GeometryModel model() const noexcept { return model_; }

  /// Returns the place of a return. `raw_counts` is the wire's distance, here not restricted to
  /// whole counts so that the inverse functions are continuous; 0 is not treated as "no return".
  [[nodiscard]] beams::Point point(int laser, double azimuth_rad, double raw_counts) const noexcept;

  /// Returns the beam, for ray casting: every point() of a laser without two_point lies on it; with
  /// two_point the nearer ones are up to centimetres beside it (then use raw_on_plane()).
  [[nodiscard]] beams::Ray ray(int laser, double azimuth_rad) const noexcept;

  /// Returns the raw counts, not rounded, for which |point()| == range_m to within 1e-9 m; nothing
  /// if they are outside [1, 65535].
  [[nodiscard]] std::optional<double> raw_for_range(int laser, double azimuth_rad,
                                                    double range_m) const noexcept;

  /// Returns the raw counts, not rounded, for which point() lies on the plane through `hit` with
  /// `normal` (any length) to within 1e-9 m; nothing if they are outside [1, 65535] or the beam
  /// runs along the plane. `hit` should be where ray() meets the plane.
  [[nodiscard]] std::optional<double> raw_on_plane(int laser, double azimuth_rad,
                                                   const beams::Point& hit,
                                                   const beams::Direction& normal) const noexcept;

 private:
  /// One laser's constants, with the sines and cosines of its angles worked out.
  struct Beam {
    double rot_rad, cos_vert, sin_vert;
    double far_m, near_x_m, near_y_m;
    double slope_x, slope_y;                ///< (D - DX) / (25.04 - 2.40), and the same along y.
    double horiz_m, xy_start_m, z_start_m;  ///< Where the beam starts: sideways, along it, up.
    bool two_point;
  };

  [[nodiscard]] const Beam& beam(int laser) const noexcept {
    return beams_[static_cast<std::size_t>(laser)];
  }
  [[nodiscard]] beams::Point point(const Beam& beam, double sin_a, double cos_a,
                                   double raw_counts) const noexcept;

  GeometryModel model_;
  double resolution_m_;
  double interpolation_end_m_;  ///< The upper limit of rr and ff.
  std::array<Beam, kHdl64eLasers> beams_{};
};

}  // namespace terracut::hdl64e
