// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Dense>
#include <Eigen/StdVector>
#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>
#include <cstddef>
#include <cstdint>
#include <vector>

/// Replaces PCL's headers for peers that use its clouds only as vectors of points, because PCL
/// brings 427 packages. Points are aligned as in PCL, and the same standard headers are included.
namespace pcl {

struct PCLHeader {};

template <class Point>
struct PointCloud {
  using Ptr = boost::shared_ptr<PointCloud>;
  using ConstPtr = boost::shared_ptr<const PointCloud>;

  PCLHeader header;
  std::vector<Point, Eigen::aligned_allocator<Point>> points;

  std::size_t size() const { return points.size(); }
  bool empty() const { return points.empty(); }
  void reserve(std::size_t size) { points.reserve(size); }
  void clear() { points.clear(); }
  void push_back(const Point& point) { points.push_back(point); }
  auto begin() const { return points.begin(); }
  auto end() const { return points.end(); }
  auto begin() { return points.begin(); }
  auto end() { return points.end(); }
  const Point& operator[](std::size_t i) const { return points[i]; }
  PointCloud& operator+=(const PointCloud& other) {
    points.insert(points.end(), other.points.begin(), other.points.end());
    return *this;
  }
};

struct alignas(16) PointXYZ {
  float x = 0, y = 0, z = 0;
};
struct alignas(16) PointXYZI {
  float x = 0, y = 0, z = 0, intensity = 0;
};

namespace visualization {
class PCLVisualizer {};
}  // namespace visualization

/// Computes mean and covariance in one pass in float, relative to the first point.
template <class Point>
unsigned computeMeanAndCovarianceMatrix(const PointCloud<Point>& cloud, Eigen::Matrix3f& covariance,
                                        Eigen::Vector4f& mean) {
  if (cloud.size() == 0) return 0;
  const Eigen::Vector3f shift(cloud[0].x, cloud[0].y, cloud[0].z);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  Eigen::Matrix3f squares = Eigen::Matrix3f::Zero();
  for (const Point& point : cloud) {
    const Eigen::Vector3f p = Eigen::Vector3f(point.x, point.y, point.z) - shift;
    sum += p;
    squares += p * p.transpose();
  }
  const auto count = static_cast<float>(cloud.size());
  sum /= count;
  covariance = squares / count - sum * sum.transpose();
  mean << sum + shift, 1.0F;
  return static_cast<unsigned>(cloud.size());
}

}  // namespace pcl

#define PCL_ADD_POINT4D \
  struct {              \
    float x, y, z, w;   \
  }
#define POINT_CLOUD_REGISTER_POINT_STRUCT(...)
