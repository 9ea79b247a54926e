// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A peer of tools/beside_peer --objects that makes the obstacles of each metre of x an object, and
// says things on the way.
#include "tools/research/peers/object_peers/object_peer_program.hpp"

namespace {

class MadeUpObjectPeer {
 public:
  using Scan = terracut::object_peers::MarkedScan;

  static Scan scan_of(const Scan& scan) { return scan; }
  void prepare(const Scan& scan) { objects_.assign(scan.points.size(), 0); }
  void segment(const Scan& scan) {
    std::printf("segmenting\n");
    for (const std::size_t i : terracut::object_peers::obstacles_of(scan)) {
      objects_[i] = 100 + static_cast<std::uint32_t>(scan.points[i][0]);
    }
  }
  std::vector<std::uint32_t> object_of(const Scan&) { return objects_; }

 private:
  std::vector<std::uint32_t> objects_;
};

}  // namespace

int main(int argc, char** argv) {
  return terracut::object_peers::run_object_peer<MadeUpObjectPeer>(argc, argv);
}
