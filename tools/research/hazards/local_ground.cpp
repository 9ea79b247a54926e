// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "local_ground.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace terracut::hazards {

std::optional<LocalGround> local_ground(std::span<const Eigen::Vector3d> points, double x_m,
                                        double y_m) {
  constexpr std::size_t kFewest = 6;
  constexpr int kRounds = 5;
  constexpr double kUsual_m = 0.03;   // points nearer to the plane have full weight
  constexpr double kLevel_m2 = 0.04;  // squared spread of points below which the slope fades
  if (points.size() < kFewest) return std::nullopt;
  std::vector<double> heights_m;
  for (const Eigen::Vector3d& point : points) heights_m.push_back(point.z());
  const auto middle = heights_m.begin() + static_cast<std::ptrdiff_t>(heights_m.size() / 2);
  std::ranges::nth_element(heights_m, middle);
  Eigen::Vector3d plane(*middle, 0, 0);  // height, rises
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    Eigen::Vector3d products = Eigen::Vector3d::Zero();
    double weights = 0;
    for (const Eigen::Vector3d& point : points) {
      const Eigen::Vector3d row(1, point.x() - x_m, point.y() - y_m);
      const double residual_m = std::abs(point.z() - row.dot(plane));
      const double weight = residual_m <= kUsual_m ? 1 : kUsual_m / residual_m;
      squares += weight * row * row.transpose();
      products += weight * point.z() * row;
      weights += weight;
    }
    squares(1, 1) += weights * kLevel_m2;
    squares(2, 2) += weights * kLevel_m2;
    plane = squares.ldlt().solve(products);
  }
  return LocalGround{plane[0], plane[1], plane[2]};
}

}  // namespace terracut::hazards
