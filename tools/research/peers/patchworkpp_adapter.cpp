// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Patchwork++ as a peer of tools/beside_peer.
#include "patchwork/patchworkpp.h"

#include "peer_program.hpp"

namespace {

class PatchworkPp {
 public:
  using Scan = Eigen::MatrixXf;

  static Scan scan_of(const std::vector<terracut::peers::Point>& points) {
    Scan scan(static_cast<Eigen::Index>(points.size()), 4);
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        scan(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = points[i][k];
      }
    }
    return scan;
  }
  void prepare(const Scan&) {}
  void segment(const Scan& scan) { estimator_.estimateGround(scan); }
  std::vector<bool> is_ground(const Scan& scan) {
    std::vector<bool> of_point(static_cast<std::size_t>(scan.rows()));
    for (const int i : estimator_.getGroundIndices()) of_point[static_cast<std::size_t>(i)] = true;
    return of_point;
  }

 private:
  patchwork::PatchWorkpp estimator_{patchwork::Params()};  // its defaults are for KITTI
};

}  // namespace

int main(int argc, char** argv) {
  return terracut::peers::run_peer<PatchworkPp>(argc, argv);
}
