// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// FugSeg as a peer of tools/beside_peer.
#include "fugseg/fugseg.h"
#include "peer_program.hpp"

namespace {

class FugSeg {
 public:
  using Scan = fugseg::Cloud;

  static Scan scan_of(const std::vector<terracut::peers::Point>& points) {
    Scan scan;
    scan.Reset(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        scan.points()(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = points[i][k];
      }
    }
    return scan;
  }
  /// Reserves memory, which makes the call faster; FugSeg's own viewer lets the lists grow in the
  /// call.
  void prepare(const Scan& scan) {
    for (fugseg::Cluster3D* const list : {&ground_, &others_}) {
      list->clear();
      list->reserve(static_cast<std::size_t>(scan.points().rows()));
    }
  }
  void segment(const Scan& scan) { extractor_.ExtractGround(scan, ground_, others_); }
  std::vector<bool> is_ground(const Scan& scan) {
    std::vector<bool> of_point(static_cast<std::size_t>(scan.points().rows()));
    for (const std::size_t i : ground_) of_point[i] = true;
    return of_point;
  }

 private:
  // These are the defaults of FugSeg's viewer, for KITTI.
  fugseg::GroundExtractor extractor_{120, 1.0F, 0.15F, 7.0F, 10.0F};
  fugseg::Cluster3D ground_, others_;
};

}  // namespace

int main(int argc, char** argv) {
  return terracut::peers::run_peer<FugSeg>(argc, argv);
}
