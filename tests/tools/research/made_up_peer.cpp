// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A peer of tools/beside_peer that calls every other point ground, and says things on the way.
#include "tools/research/peers/peer_program.hpp"

namespace {

class MadeUpPeer {
 public:
  using Scan = std::size_t;

  MadeUpPeer() { std::cout << "hello\n"; }
  static Scan scan_of(const std::vector<terracut::peers::Point>& points) { return points.size(); }
  void prepare(const Scan&) {}
  void segment(const Scan& points) {
    std::cout << "segmenting\n";
    ground_.assign(points, false);
    for (std::size_t i = 0; i < points; i += 2) ground_[i] = true;
  }
  std::vector<bool> is_ground(const Scan&) { return ground_; }

 private:
  std::vector<bool> ground_;
};

}  // namespace

int main(int argc, char** argv) {
  return terracut::peers::run_peer<MadeUpPeer>(argc, argv);
}
