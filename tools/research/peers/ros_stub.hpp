// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>
#include <vector>

#include "pcl_stub.hpp"

/// Replaces the headers of ROS for peers that only log through it, or fill messages for a display
/// that is off. Nothing here does anything.
#define ROS_INFO(...)
#define ROS_WARN(...)
#define ROS_ERROR(...)
#define ROS_DEBUG_STREAM(...)

namespace ros {
struct NodeHandle {};
}  // namespace ros

namespace std_msgs {
struct Header {
  std::string frame_id;
};
}  // namespace std_msgs

namespace sensor_msgs {
struct PointCloud2 {
  std_msgs::Header header;
};
}  // namespace sensor_msgs

namespace geometry_msgs {
struct Point {
  double x = 0, y = 0, z = 0;
};
struct Point32 {
  float x = 0, y = 0, z = 0;
};
struct PointStamped {
  std_msgs::Header header;
  Point point;
};
struct TransformStamped {};
struct PolygonStamped {
  std_msgs::Header header;
  struct {
    std::vector<Point32> points;
  } polygon;
};
}  // namespace geometry_msgs

namespace jsk_recognition_msgs {
struct PolygonArray {
  std_msgs::Header header;
  std::vector<geometry_msgs::PolygonStamped> polygons;
  std::vector<float> likelihood;
};
}  // namespace jsk_recognition_msgs

namespace visualization_msgs {
struct Marker {
  enum { ADD, LINE_LIST };
  std_msgs::Header header;
  std::string ns;
  int id = 0, type = 0, action = 0;
  struct {
    double x = 0, y = 0, z = 0;
  } scale;
  struct {
    struct {
      double x = 0, y = 0, z = 0, w = 0;
    } orientation;
  } pose;
  struct {
    float r = 0, g = 0, b = 0, a = 0;
  } color;
  std::vector<geometry_msgs::Point> points;
};
}  // namespace visualization_msgs

namespace tf2 {
/// Returns the point unchanged, which is right for a vehicle at the map's origin.
inline void doTransform(const geometry_msgs::PointStamped& in, geometry_msgs::PointStamped& out,
                        const geometry_msgs::TransformStamped&) {
  out = in;
}
}  // namespace tf2

namespace pcl_conversions {
inline void fromPCL(const pcl::PCLHeader&, std_msgs::Header&) {}
}  // namespace pcl_conversions
namespace pcl {
template <class Point>
void toROSMsg(const PointCloud<Point>&, sensor_msgs::PointCloud2&) {}
}  // namespace pcl
