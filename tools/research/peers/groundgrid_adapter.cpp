// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The core of GroundGrid as a peer of tools/beside_peer: each scan alone, without odometry.
#include "groundgrid/GroundSegmentation.h"
#include "peer_program.hpp"

namespace {

using groundgrid::GroundSegmentation;
using Cloud = pcl::PointCloud<GroundSegmentation::PCLPoint>;

// The sensor's height above the vehicle's frame, as in the method's launch files.
constexpr float kSensorHeight_m = 1.73F;
constexpr float kMap_m = 120, kCell_m = .33F;  // as in GroundGrid.h

class GroundGrid {
 public:
  using Scan = Cloud::Ptr;

  GroundGrid() {
    ros::NodeHandle node;
    method_.init(node, static_cast<std::size_t>(kMap_m), kCell_m);
    method_.setConfig({});
    map_.setGeometry(grid_map::Length(kMap_m, kMap_m), kCell_m, grid_map::Position(0, 0));
    sensor_.x = sensor_.y = 0;
    sensor_.z = kSensorHeight_m;
  }
  /// Returns the points in the vehicle's frame. All rings are 0: the method only compares them with
  /// a limit, which is not set by default.
  static Scan scan_of(const std::vector<terracut::peers::Point>& points) {
    Scan scan(new Cloud);
    for (std::size_t i = 0; i < points.size(); ++i) {
      GroundSegmentation::PCLPoint point{};
      point.x = points[i][0];
      point.y = points[i][1];
      point.z = points[i][2] + kSensorHeight_m;
      point.ring = 0;
      scan->push_back(point);
    }
    return scan;
  }
  /// Resets the map to its state before the first odometry, as GroundGrid::initGroundGrid() does.
  void prepare(const Scan&) {
    map_["points"].setZero();
    map_["ground"].setConstant(0);
    map_["groundpatch"].setConstant(0.0000001F);
    map_["minGroundHeight"].setConstant(100);
    map_["maxGroundHeight"].setConstant(-100);
  }
  void segment(const Scan& scan) { labelled_ = method_.filter_cloud(scan, sensor_, {}, map_); }
  /// The method returns a cloud without the points' indices, so points are found by their
  /// coordinates. Ground has the value 49.
  std::vector<bool> is_ground(const Scan& scan) {
    const auto key = [](const GroundSegmentation::PCLPoint& p) {
      return std::array<float, 3>{p.x, p.y, p.z};
    };
    std::map<std::array<float, 3>, bool> of_place;
    for (const auto& point : *labelled_) of_place[key(point)] = point.intensity == 49;
    std::vector<bool> of_point;
    for (const auto& point : *scan) {
      const auto found = of_place.find(key(point));
      of_point.push_back(found != of_place.end() && found->second);
    }
    return of_point;
  }

 private:
  GroundSegmentation method_;
  grid_map::GridMap map_{std::vector<std::string>{"points", "ground", "groundpatch",
                                                  "minGroundHeight", "maxGroundHeight"}};
  GroundSegmentation::PCLPoint sensor_{};
  Cloud::Ptr labelled_;
};

}  // namespace

int main(int argc, char** argv) {
  return terracut::peers::run_peer<GroundGrid>(argc, argv);
}
