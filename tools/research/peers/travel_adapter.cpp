// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// TRAVEL's ground segmentation as a peer of tools/beside_peer.
#include "peer_program.hpp"
#include "travel/tgs.hpp"

namespace {

struct alignas(16) Point {
  float x, y, z, intensity;
  std::uint32_t index;
};

class Travel {
 public:
  using Scan = pcl::PointCloud<Point>;

  Travel() {
    // These are the values of the method's config/kitti_params.yaml.
    method_.setParams(64.0, 1.0, 8.0, 3, 5, 10, 0.5, 0.125, 0.3, 0.940, 200, 0.03, 0.1, 1.0, true,
                      false);
  }
  static Scan scan_of(const std::vector<terracut::peers::Point>& points) {
    Scan scan;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      scan.push_back({points[i][0], points[i][1], points[i][2], points[i][3], i});
    }
    return scan;
  }
  void prepare(const Scan&) {}
  void segment(const Scan& scan) {
    double took_s = 0;
    method_.estimateGround(scan, ground_, others_, took_s);
  }
  std::vector<bool> is_ground(const Scan& scan) {
    std::vector<bool> of_point(scan.size());
    for (const Point& point : ground_) of_point[point.index] = true;
    return of_point;
  }

 private:
  travel::TravelGroundSeg<Point> method_;
  Scan ground_, others_;
};

}  // namespace

int main(int argc, char** argv) {
  return terracut::peers::run_peer<Travel>(argc, argv);
}
