// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// terracut's library as the peers of ./tools/beside_clouds are: clouds in memory in, labels out.
// REPEAT LABELS SCAN.bin..., scans in KITTI's order; of sensors with other than 64 rings the
// library is told the laser of each point, as drivers do.
#include <cstdlib>
#include <span>
#include <vector>

#include "firmware_io/scan/ring_recovery.hpp"
#include "terracut/segmenter.hpp"
#include "tools/research/peers/peer_program.hpp"

namespace {

class Terracut {
 public:
  struct Scan {
    std::vector<terracut::CloudPoint> points;
    std::vector<std::uint16_t> laser;
  };

  static Scan scan_of(const std::vector<terracut::peers::Point>& points) {
    Scan scan;
    for (const auto& [x_m, y_m, z_m, remission] : points)
      scan.points.push_back({x_m, y_m, z_m, remission});
    terracut::scan::RingRecovery rings;
    if (!terracut::scan::split_into_rings(scan.points, rings)) std::abort();
    if (rings.rings == terracut::scan::kScanRings) return scan;
    for (const std::int16_t ring : rings.ring_of_point)
      scan.laser.push_back(static_cast<std::uint16_t>(ring < 0 ? 0 : ring));
    return scan;
  }
  void prepare(const Scan&) {}
  void segment(const Scan& scan) {
    const auto labels = segmenter_.label(terracut::Cloud{scan.points, scan.laser});
    if (!labels) std::abort();
    labels_ = *labels;
  }
  std::vector<bool> is_ground(const Scan&) {
    std::vector<bool> of_point;
    for (const auto label : labels_) of_point.push_back(label == terracut::Label::kGround);
    return of_point;
  }

 private:
  terracut::Segmenter segmenter_ = terracut::Segmenter::make({.mount = {.height_m = 1.73}}).value();
  std::span<const terracut::Label> labels_;
};

}  // namespace

int main(int argc, char** argv) {
  return terracut::peers::run_peer<Terracut>(argc, argv);
}
