// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/sensor_pose.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "calib/mount/mount_pose.hpp"
#include "firmware_io/scan/ring_fit_of_scans.hpp"

namespace terracut::cloud {
namespace {

constexpr std::size_t kPointsOfACloud = 8000;
constexpr double kNearest_m = 2, kFarthest_m = 70;
constexpr std::size_t kFewestLasersSeen = 8;
/// The unknowns: two rotations about the sensor's horizontal axes, and the three coordinates of its
/// position.
constexpr std::size_t kUnknowns = 5;
using Vector = std::array<double, kUnknowns>;
using Matrix = std::array<Vector, kUnknowns>;

struct Sample {
  std::array<double, 3> at_m;  ///< In the points' frame.
  std::size_t laser;
};

/// Solves A x = b for a positive definite A by elimination without pivots.
Vector solve(Matrix A, Vector b) {
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    for (std::size_t row = i + 1; row < kUnknowns; ++row) {
      const double share = A[row][i] / A[i][i];
      for (std::size_t column = i; column < kUnknowns; ++column) {
        A[row][column] -= share * A[i][column];
      }
      b[row] -= share * b[i];
    }
  }
  for (std::size_t i = kUnknowns; i-- > 0;) {
    for (std::size_t column = i + 1; column < kUnknowns; ++column) b[i] -= A[i][column] * b[column];
    b[i] /= A[i][i];
  }
  return b;
}

/// Returns the frame with its origin at `at_m`, its z axis along `axis` and its x axis ahead.
mount::RigidTransform frame_of(const std::array<double, 3>& axis,
                               const std::array<double, 3>& at_m) {
  mount::RigidTransform T =
      mount::T_vehicle_lidar({.height_m = 0,
                              .roll_rad = -std::asin(std::clamp(axis[1], -1.0, 1.0)),
                              .pitch_rad = std::atan2(axis[0], axis[2])});
  for (std::size_t i = 0; i < 3; ++i) T[4 * i + 3] = at_m[i];
  return T;
}

/// Returns samples of all clouds with their lasers; nothing if a cloud does not name the lasers.
std::vector<Sample> samples_of(std::size_t clouds, const ReadCloud& read) {
  std::vector<Sample> samples;
  scan::RingRecovery rings;
  const Status looked = scan::read_some_scans(clouds, [&](std::size_t index) -> Status {
    const auto cloud = read(index);
    if (!cloud) return tl::unexpected(cloud.error());
    const bool has_numbers = cloud->laser.size() == cloud->points.size();
    const bool is_organised = !has_numbers && cloud->is_organised();
    if (!has_numbers && !is_organised) {
      if (Status split = scan::recover_rings(cloud->points, nullptr, rings); !split) return split;
    }
    const std::size_t step = cloud->points.size() / kPointsOfACloud + 1;
    for (std::size_t i = 0; i < cloud->points.size(); i += step) {
      const scan::ScanPoint& p = cloud->points[i];
      const double range_m = std::hypot(double{p.x_m}, double{p.y_m}, double{p.z_m});
      if (!(range_m > kNearest_m && range_m < kFarthest_m)) continue;
      std::size_t laser = 0;
      if (has_numbers) {
        laser = cloud->laser[i];
      } else if (is_organised) {
        laser = OrganisedLasers(*cloud).of(i);
      } else if (rings.ring_of_point[i] != scan::kNoRing) {
        laser = static_cast<std::size_t>(rings.ring_of_point[i]);
      } else {
        continue;
      }
      samples.push_back({{double{p.x_m}, double{p.y_m}, double{p.z_m}}, laser});
    }
    return {};
  });
  return looked ? samples : std::vector<Sample>{};
}

/// Fits the sensor's frame by Gauss-Newton. A sample's residual is its height above its laser's
/// cone, z - slope * distance. Cauchy weights reduce the influence of points far off their cone.
class PoseFit {
 public:
  explicit PoseFit(std::vector<Sample> samples) : samples_(std::move(samples)) {
    for (const Sample& sample : samples_) lasers_ = std::max(lasers_, sample.laser + 1);
  }

  [[nodiscard]] const mount::RigidTransform& T_points_sensor() const { return T_; }
  /// Returns the median distance of the samples from their cones in metres.
  [[nodiscard]] double residual_m() const { return median_m_; }
  [[nodiscard]] std::size_t lasers_seen() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(slopes_, [](double slope) { return std::isfinite(slope); }));
  }

  /// Makes one step. Returns how far it moved the frame, in radians and metres together.
  double step() {
    look_from_frame();
    Matrix normal{};
    Vector right{};
    std::vector<Vector> of_slope(lasers_, Vector{});
    std::vector<double> squares(lasers_), sums(lasers_);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const std::size_t laser = samples_[i].laser;
      const auto& [x, y, z] = seen_[i];
      const double d = std::hypot(x, y), slope = slopes_[laser], f = z - slope * d;
      const double weight = weight_of(f);
      const Vector g{-y - slope * y * z / d, x + slope * x * z / d, slope * x / d, slope * y / d,
                     -1};
      for (std::size_t row = 0; row < kUnknowns; ++row) {
        for (std::size_t column = 0; column < kUnknowns; ++column) {
          normal[row][column] += weight * g[row] * g[column];
        }
        right[row] -= weight * g[row] * f;
        of_slope[laser][row] += weight * d * g[row];
      }
      squares[laser] += weight * d * d;
      sums[laser] += weight * d * f;
    }
    // Eliminates the laser's slope, which is an unknown, too.
    for (std::size_t laser = 0; laser < lasers_; ++laser) {
      if (squares[laser] <= 0) continue;
      for (std::size_t row = 0; row < kUnknowns; ++row) {
        for (std::size_t column = 0; column < kUnknowns; ++column) {
          normal[row][column] -= of_slope[laser][row] * of_slope[laser][column] / squares[laser];
        }
        right[row] += of_slope[laser][row] * sums[laser] / squares[laser];
      }
    }
    // Relative to a sample's weight; keeps unknowns that the points do not show as they are.
    constexpr double kDamping = 1e-3;
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      normal[i][i] += kDamping * static_cast<double>(samples_.size());
    }
    return move(solve(normal, right));
  }

  /// Computes the samples' positions in the frame, the slope of each laser, and the residuals.
  void look_from_frame() {
    const mount::RigidTransform to_sensor = mount::inverse(T_);
    seen_.clear();
    for (const Sample& sample : samples_) {
      seen_.push_back(mount::apply(to_sensor, sample.at_m[0], sample.at_m[1], sample.at_m[2]));
    }
    std::vector<std::vector<double>> slopes(lasers_);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const auto& [x, y, z] = seen_[i];
      slopes[samples_[i].laser].push_back(z / std::max(std::hypot(x, y), 1e-3));
    }
    slopes_.assign(lasers_, NAN);
    for (std::size_t laser = 0; laser < lasers_; ++laser) {
      if (slopes[laser].size() >= kFewestOfALaser) slopes_[laser] = median_of(slopes[laser]);
    }
    drop_lasers_without_slope();
    std::vector<double> residuals;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const auto& [x, y, z] = seen_[i];
      residuals.push_back(std::abs(z - slopes_[samples_[i].laser] * std::hypot(x, y)));
    }
    if (!residuals.empty()) median_m_ = median_of(residuals);
  }

 private:
  static constexpr std::size_t kFewestOfALaser = 10;

  static double median_of(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
  }

  [[nodiscard]] double weight_of(double f) const {
    const double scale_m = std::max(2 * median_m_, 0.03);
    return 1 / (1 + f * f / (scale_m * scale_m));
  }

  void drop_lasers_without_slope() {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (!std::isfinite(slopes_[samples_[i].laser])) continue;
      samples_[kept] = samples_[i];
      seen_[kept++] = seen_[i];
    }
    samples_.resize(kept);
    seen_.resize(kept);
  }

  /// Moves the frame by a small rotation about its x and y axes and a shift along its axes.
  double move(const Vector& by) {
    const mount::RigidTransform T = T_;
    std::array<double, 3> axis{}, at_m{};
    for (std::size_t i = 0; i < 3; ++i) {
      axis[i] = T[4 * i] * by[1] - T[4 * i + 1] * by[0] + T[4 * i + 2];
      at_m[i] = T[4 * i + 3] + T[4 * i] * by[2] + T[4 * i + 1] * by[3] + T[4 * i + 2] * by[4];
    }
    const double length = std::hypot(axis[0], axis[1], axis[2]);
    for (double& along : axis) along /= length;
    T_ = frame_of(axis, at_m);
    return std::hypot(by[0], by[1]) + std::hypot(by[2], by[3], by[4]);
  }

  std::vector<Sample> samples_;
  std::size_t lasers_ = 0;
  mount::RigidTransform T_ = frame_of({0, 0, 1}, {0, 0, 0});
  std::vector<std::array<double, 3>> seen_;  ///< The samples' positions in the frame.
  std::vector<double> slopes_;               ///< NaN for a laser with too few samples.
  double median_m_ = 0;
};

}  // namespace

std::optional<mount::RigidTransform> find_sensor_pose(std::size_t clouds, const ReadCloud& read) {
  constexpr int kMostSteps = 60;
  constexpr double kStands = 1e-5;
  PoseFit fit(samples_of(clouds, read));
  fit.look_from_frame();
  if (fit.lasers_seen() < kFewestLasersSeen) return std::nullopt;
  const double at_origin_m = fit.residual_m();
  double moved = 1;
  for (int i = 0; i < kMostSteps && moved > kStands; ++i) moved = fit.step();
  fit.look_from_frame();
  const auto& T = fit.T_points_sensor();
  const bool is_place = std::ranges::all_of(T, [](double term) { return std::isfinite(term); });
  if (!is_place || !(fit.residual_m() < at_origin_m)) return std::nullopt;
  return T;
}

void move_points(const mount::RigidTransform& T, std::span<scan::ScanPoint> points) noexcept {
  for (scan::ScanPoint& p : points) {
    if (!scan::is_place(p)) continue;
    const auto [x, y, z] = mount::apply(T, double{p.x_m}, double{p.y_m}, double{p.z_m});
    p.x_m = static_cast<float>(x);
    p.y_m = static_cast<float>(y);
    p.z_m = static_cast<float>(z);
  }
}

}  // namespace terracut::cloud
