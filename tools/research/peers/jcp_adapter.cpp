// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The JCP segmenter of LiDAR-Processing-V2 as a peer of tools/beside_peer.
#include "lidar_processing_lib/segmenter.hpp"
#include "peer_program.hpp"

namespace {

using lidar_processing_lib::Label;

class Jcp {
 public:
  using Scan = pcl::PointCloud<pcl::PointXYZI>;

  /// The default configuration equals the method's processor.param.yaml.
  Jcp() { method_.config({}); }
  /// Returns points without rings: the method then computes rows from elevations, an arctangent for
  /// each point.
  static Scan scan_of(const std::vector<terracut::peers::Point>& points) {
    Scan scan;
    for (const auto& p : points) scan.push_back({p[0], p[1], p[2], p[3]});
    return scan;
  }
  void prepare(const Scan&) {}
  void segment(const Scan& scan) { method_.segment(scan, labels_); }
  std::vector<bool> is_ground(const Scan& scan) {
    std::vector<bool> of_point(scan.size());
    for (std::size_t i = 0; i < of_point.size(); ++i) of_point[i] = labels_[i] == Label::GROUND;
    return of_point;
  }

 private:
  lidar_processing_lib::Segmenter method_;
  std::vector<Label> labels_;
};

}  // namespace

int main(int argc, char** argv) {
  return terracut::peers::run_peer<Jcp>(argc, argv);
}
