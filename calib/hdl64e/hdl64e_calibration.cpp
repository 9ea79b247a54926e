// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "calib/hdl64e/hdl64e_calibration.hpp"

#include <fmt/format.h>

#include <cmath>

#include "calib/beams/angle.hpp"
#include "calib/beams/elevation_rows.hpp"
#include "calib/text/fnv1a.hpp"

namespace terracut::hdl64e {
namespace {

/// The range of values accepted for a field: the values seen on real units
/// (docs/reference/sensors.md), plus a margin for units not seen yet and for tables fitted to
/// recordings.
struct Span {
  double low, high;
  bool contains(double v) const { return v >= low && v <= high; }  // false for NaN
};

constexpr Span kElevation_deg{-35.0, 15.0};   // seen: -25.5 .. 5.0
constexpr Span kRotation_deg{-20.0, 20.0};    // seen: -10.0 .. 10.0
constexpr Span kDistCorrection_m{-0.5, 3.0};  // seen: 0.01 .. 1.63
constexpr Span kOffset_m{-1.0, 1.0};          // seen: -0.026 .. 0.217
constexpr Span kFocalDistance_m{0.0, 131.0};  // seen: 0 .. 24
constexpr Span kFocalSlope{-20.0, 20.0};      // seen: 0 .. 2
constexpr Span kIntensity{0.0, 255.0};
constexpr Span kResolution_m{0.0005, 0.01};      // always 0.002 so far
constexpr double kMaxNearFarDifference_m = 0.5;  // seen: 0.1
constexpr double kMinElevationStep_deg = 0.005;
constexpr double kMinFieldOfView_deg = 10.0;  // seen: 26

std::string prefix(const Hdl64eCalibration& calibration) {
  return calibration.origin.empty() ? std::string("HDL-64E calibration")
                                    : "HDL-64E calibration from " + calibration.origin;
}

/// Returns a hint at the mistake that may have put `value_deg` outside its span; empty if there is
/// none.
std::string_view angle_hint(double value_deg) {
  // A table in degrees taken for radians shows 1 deg as 57 deg.
  if (std::abs(value_deg) > 40.0) return "; this looks like degrees where radians were expected";
  return "";
}
std::string_view length_hint(double value_m) {
  if (std::abs(value_m) > 500.0) {
    return "; this looks like millimetres where metres were expected";
  }
  if (std::abs(value_m) > 5.0) return "; this looks like centimetres where metres were expected";
  return "";
}

/// Checks values and keeps the first violation.
class Checker {
 public:
  explicit Checker(const Hdl64eCalibration& calibration) : calibration_(calibration) {}

  void angle(int laser, std::string_view field, double value_rad, Span span_deg) {
    const double deg = beams::rad_to_deg(value_rad);
    check(laser, field, deg, "deg", span_deg, angle_hint(deg));
  }
  void length(int laser, std::string_view field, double value_m, Span span_m) {
    check(laser, field, value_m, "m", span_m, length_hint(value_m));
  }
  void number(int laser, std::string_view field, double value, Span span) {
    check(laser, field, value, "", span, "");
  }
  void refuse(std::string what) {
    if (status_) {
      status_ = fail(ErrorCode::kMalformed, fmt::format("{}: {}", prefix(calibration_), what));
    }
  }
  Status status() const { return status_; }

 private:
  void check(int laser, std::string_view field, double value, std::string_view unit, Span span,
             std::string_view hint) {
    if (span.contains(value)) return;
    const std::string where = laser < 0 ? std::string() : fmt::format("laser {}: ", laser);
    const std::string_view space = unit.empty() ? "" : " ";
    refuse(fmt::format("{}{} is {:.6g}{}{}, expected {:g} to {:g}{}{}{}", where, field, value,
                       space, unit, span.low, span.high, space, unit, hint));
  }

  const Hdl64eCalibration& calibration_;
  Status status_;
};

void check_laser(Checker& checker, int number, const Hdl64eLaser& laser) {
  checker.angle(number, "vertical correction", laser.vert_correction_rad, kElevation_deg);
  checker.angle(number, "rotational correction", laser.rot_correction_rad, kRotation_deg);
  checker.length(number, "distance correction", laser.dist_correction_m, kDistCorrection_m);
  checker.length(number, "distance correction X", laser.dist_correction_x_m, kDistCorrection_m);
  checker.length(number, "distance correction Y", laser.dist_correction_y_m, kDistCorrection_m);
  if (laser.two_point) {
    const Span near{laser.dist_correction_m - kMaxNearFarDifference_m,
                    laser.dist_correction_m + kMaxNearFarDifference_m};
    checker.length(number, "distance correction X (two-point)", laser.dist_correction_x_m, near);
    checker.length(number, "distance correction Y (two-point)", laser.dist_correction_y_m, near);
  }
  checker.length(number, "vertical offset", laser.vert_offset_m, kOffset_m);
  checker.length(number, "horizontal offset", laser.horiz_offset_m, kOffset_m);
  checker.number(number, "focal distance in m", laser.focal_distance_m, kFocalDistance_m);
  checker.number(number, "focal slope", laser.focal_slope, kFocalSlope);
  checker.number(number, "minimum intensity", laser.min_intensity, kIntensity);
  checker.number(number, "maximum intensity", laser.max_intensity,
                 {static_cast<double>(laser.min_intensity), kIntensity.high});
}

void check_elevations(Checker& checker, const Hdl64eCalibration& calibration) {
  const auto order = beams::order_of_rows(rows_by_elevation(calibration));
  const auto elevation_deg = [&](int rank) {
    const auto laser = static_cast<std::size_t>(order[static_cast<std::size_t>(rank)]);
    return beams::rad_to_deg(calibration.lasers[laser].vert_correction_rad);
  };
  const double view_deg = elevation_deg(kHdl64eLasers - 1) - elevation_deg(0);
  if (view_deg < kMinFieldOfView_deg) {
    checker.refuse(fmt::format(
        "all 64 vertical corrections lie within {:.3g} deg, expected about 27 deg; this looks like "
        "radians where degrees were expected, or an empty table",
        view_deg));
  }
  for (int rank = 1; rank < kHdl64eLasers; ++rank) {
    if (elevation_deg(rank) - elevation_deg(rank - 1) < kMinElevationStep_deg) {
      checker.refuse(
          fmt::format("lasers {} and {} have the same vertical correction {:.4f} deg, expected 64 "
                      "distinct ones",
                      order[static_cast<std::size_t>(rank - 1)],
                      order[static_cast<std::size_t>(rank)], elevation_deg(rank)));
    }
  }
}

/// Returns `value * scale` as a whole number; INT64_MIN if it is NaN or too large.
std::int64_t rounded(double value, double scale) {
  const double scaled = value * scale;
  return std::abs(scaled) < 1e15 ? std::llround(scaled) : INT64_MIN;  // NaN gives INT64_MIN as well
}

}  // namespace

Status validate(const Hdl64eCalibration& calibration) {
  Checker checker(calibration);
  checker.number(-1, "distance resolution in m", calibration.distance_resolution_m, kResolution_m);
  for (int i = 0; i < kHdl64eLasers; ++i) {
    check_laser(checker, i, calibration.lasers[static_cast<std::size_t>(i)]);
  }
  if (checker.status()) check_elevations(checker, calibration);
  return checker.status();
}

std::uint64_t fingerprint(const Hdl64eCalibration& calibration) {
  text::Fnv1a hash;
  hash.add(rounded(calibration.distance_resolution_m, 1e6));
  for (const Hdl64eLaser& laser : calibration.lasers) {
    const double far_m = laser.dist_correction_m;
    hash.add(rounded(beams::rad_to_deg(laser.vert_correction_rad), 100));
    hash.add(rounded(beams::rad_to_deg(laser.rot_correction_rad), 100));
    hash.add(rounded(far_m, 1000));
    // Files write unused near corrections as 0, as a copy of the far one, or not at all; all three
    // are hashed as the far one.
    hash.add(rounded(laser.two_point ? laser.dist_correction_x_m : far_m, 1000));
    hash.add(rounded(laser.two_point ? laser.dist_correction_y_m : far_m, 1000));
    hash.add(rounded(laser.vert_offset_m, 1000));
    hash.add(rounded(laser.horiz_offset_m, 1000));
    hash.add(rounded(laser.focal_distance_m, 1000));
    hash.add(rounded(laser.focal_slope, 10));
    hash.add(laser.min_intensity);
    hash.add(laser.max_intensity);
  }
  return hash.value();
}

std::array<int, kHdl64eLasers> rows_by_elevation(const Hdl64eCalibration& calibration) {
  std::array<double, kHdl64eLasers> elevation_rad{};
  for (std::size_t i = 0; i < elevation_rad.size(); ++i) {
    elevation_rad[i] = calibration.lasers[i].vert_correction_rad;
  }
  return beams::rows_of_elevations(elevation_rad);
}

}  // namespace terracut::hdl64e
