// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// linefit_ground_segmentation as a peer of tools/beside_peer.
#include "ground_segmentation/ground_segmentation.h"
#include "peer_program.hpp"

namespace {

GroundSegmentationParams kitti_params() {
  // The values of the method's launch/segmentation_params.yaml, with one thread and KITTI's sensor
  // height.
  GroundSegmentationParams params;
  params.n_threads = 1;
  params.r_min_square = 0.5 * 0.5;
  params.r_max_square = 50 * 50;
  params.n_bins = 120;
  params.n_segments = 360;
  params.max_dist_to_line = 0.05;
  params.sensor_height = 1.73;
  params.min_slope = 0.0;
  params.max_slope = 0.3;
  params.max_error_square = 0.05 * 0.05;
  params.long_threshold = 1.0;
  params.max_long_height = 0.1;
  params.max_start_height = 0.2;
  params.line_search_angle = 0.1;
  return params;
}

class Linefit {
 public:
  using Scan = PointCloud;

  static Scan scan_of(const std::vector<terracut::peers::Point>& points) {
    Scan scan;
    for (const auto& p : points) scan.push_back({p[0], p[1], p[2]});
    return scan;
  }
  void prepare(const Scan&) {}
  void segment(const Scan& scan) { segmenter_.segment(scan, &ground_); }
  std::vector<bool> is_ground(const Scan&) { return {ground_.begin(), ground_.end()}; }

 private:
  GroundSegmentation segmenter_{kitti_params()};
  std::vector<int> ground_;
};

}  // namespace

/// Replaces the method's viewer, which is not used.
Viewer::Viewer() = default;
Viewer::~Viewer() = default;
void Viewer::visualize(const std::list<PointLine>&, const PointCloud::ConstPtr&,
                       const PointCloud::ConstPtr&, const PointCloud::ConstPtr&) {}

int main(int argc, char** argv) {
  return terracut::peers::run_peer<Linefit>(argc, argv);
}
