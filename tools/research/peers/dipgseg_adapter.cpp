// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// DipG-Seg as a peer of tools/beside_peer.

#include "dipgseg.h"
#include "peer_program.hpp"

namespace {

struct alignas(16) Point {
  float x, y, z, intensity;
};

class DipgSeg {
 public:
  using Scan = pcl::PointCloud<Point>;

  static Scan scan_of(const std::vector<terracut::peers::Point>& points) {
    Scan scan;
    for (const auto& p : points) scan.push_back({p[0], p[1], p[2], p[3]});
    return scan;
  }
  void prepare(const Scan& scan) {
    cloud_ = scan;  // a copy, because the method may change its cloud
    ground_.clear();
    others_.clear();
    is_ground_.assign(scan.size(), 0);
  }
  /// Calls the method to find the ground points, with the parameters of its paper.
  void segment(const Scan&) {
    method_.segment_ground_eval(cloud_, ground_, others_, is_ground_.data());
  }
  std::vector<bool> is_ground(const Scan&) { return {is_ground_.begin(), is_ground_.end()}; }

 private:
  DIPGSEG::Dipgseg method_;
  Scan cloud_, ground_, others_;
  std::vector<std::size_t> is_ground_;
};

}  // namespace

int main(int argc, char** argv) {
  return terracut::peers::run_peer<DipgSeg>(argc, argv);
}
