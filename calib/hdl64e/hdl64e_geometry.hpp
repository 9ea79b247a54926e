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

/// How a laser's offsets enter the coordinates of its points (docs/reference/sensors.md).
enum class GeometryModel : std::uint8_t {
  kManual,   ///< As the maker's sample code: vertical offset straight up, two-point up to 25.04 m.
  kRosLike,  ///< As ROS drivers do: vertical offset across the beam, two-point extrapolated.
};

/// The distances at which two-point calibration measures (HDL-64E S3 manual Rev K, appendix F).
inline constexpr double kFarPoint_m = 25.04;
inline constexpr double kNearPointX_m = 2.40;
inline constexpr double kNearPointY_m = 1.93;

/// Converts raw counts to metres and back for one HDL-64E, in double. The packet decoder's float
/// loop is checked against this class; the simulator and the encoder invert it.
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
/// In all functions, `laser` is in [0, 64); `azimuth_rad` is the head's azimuth when the laser
/// fires, clockwise from straight ahead seen from above, any revolution. Immutable, so any thread
/// may call them; no allocation, no locks; each call computes a few trigonometric functions (too
/// slow for the per-packet path).
class Hdl64eGeometry {
 public:
  explicit Hdl64eGeometry(const Hdl64eCalibration& calibration,
                          GeometryModel model = GeometryModel::kManual) noexcept;

  [[nodiscard]] GeometryModel model() const noexcept { return model_; }

  /// Returns the point of a return. `raw_counts`, the distance in the packet, need not be whole
  /// here, so that the inverse functions are continuous; 0 is not treated as "no return".
  [[nodiscard]] beams::Point point(int laser, double azimuth_rad, double raw_counts) const noexcept;

  /// Returns the beam, for ray casting. Every point() of a laser without two_point lies on this
  /// beam; with two_point, near points lie up to centimetres beside it (use raw_on_plane() for
  /// those).
  [[nodiscard]] beams::Ray ray(int laser, double azimuth_rad) const noexcept;

  /// Returns the raw counts, not rounded, for which |point()| == range_m to within 1e-9 m; nothing
  /// if the counts are outside [1, 65535].
  [[nodiscard]] std::optional<double> raw_for_range(int laser, double azimuth_rad,
                                                    double range_m) const noexcept;

  /// Returns the raw counts, not rounded, for which point() lies on the plane through `hit` with
  /// `normal` (any length) to within 1e-9 m; nothing if the counts are outside [1, 65535] or the
  /// beam runs along the plane. `hit` should be where ray() meets the plane.
  [[nodiscard]] std::optional<double> raw_on_plane(int laser, double azimuth_rad,
                                                   const beams::Point& hit,
                                                   const beams::Direction& normal) const noexcept;

 private:
  /// The constants of one laser, with the sines and cosines of its angles.
  struct Beam {
    double rot_rad, cos_vert, sin_vert;
    double far_m, near_x_m, near_y_m;
    double slope_x, slope_y;  ///< (D - DX) / (25.04 - 2.40) and (D - DY) / (25.04 - 1.93).
    double horiz_m, xy_start_m, z_start_m;  ///< The beam's start: sideways, along the beam, up.
    bool two_point;
  };

  [[nodiscard]] const Beam& beam(int laser) const noexcept {
    return beams_[static_cast<std::size_t>(laser)];
  }
  [[nodiscard]] beams::Point point(const Beam& beam, double sin_a, double cos_a,
                                   double raw_counts) const noexcept;

  GeometryModel model_;
  double resolution_m_;
  double interpolation_end_m_;  ///< Upper limit of rr and ff in the formulas above.
  std::array<Beam, kHdl64eLasers> beams_{};
};

}  // namespace terracut::hdl64e
