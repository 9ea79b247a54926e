// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/ring_table.hpp"
#include "rt/error.hpp"

namespace terracut::scan {

/// The ring of every point of a scan, found from the order of the file. Buffers are reused from
/// scan to scan.
struct RingRecovery {
  /// Ring from 0 (top) to rings - 1; kNoRing for a point without a ring.
  std::vector<std::int16_t> ring_of_point;
  int rings = 0;            ///< Number of rings found in the file's order.
  std::size_t no_ring = 0;  ///< Points with kNoRing, including those without a valid position.
  bool aligned = false;     ///< True if align_rings() has renumbered the rings.
};

/// Splits a scan into rings (the paper's backtracking). KITTI files hold ring after ring from the
/// top, each counter-clockwise from straight ahead, so a new ring starts where the azimuth falls
/// back past straight ahead (with x > 0, y goes from negative to >= 0; -0.0 is 0). Steps back over
/// that line by less than ten degrees, from motion compensation, stay in their ring. If this does
/// not give 64 rings, the view may be cropped, with nothing straight ahead: then every fall by more
/// than 20 degrees starts a ring. Points without a valid position (is_place()) get kNoRing. Fails
/// with kMalformed if no point has a valid position, or if there are many more crossings than in
/// any scan in ring order (a shuffled or otherwise sorted file).
[[nodiscard]] Status split_into_rings(std::span<const ScanPoint> points, RingRecovery& recovery);

/// Renumbers the rings of a scan whose count is not 64 (a laser without returns, a torn ring, a
/// cropped view) by the known elevations: of all assignments that keep the order, takes the one
/// with the least angular error. Rings with points at the same azimuths are not of one laser; rings
/// that fit no laser get kNoRing. Afterwards `rings` is 64. Fails with kMalformed if less than half
/// of the points fit a laser, as in a file in another order.
[[nodiscard]] Status align_rings(std::span<const ScanPoint> points, const RingTable& table,
                                 RingRecovery& recovery);

/// Does split_into_rings(), then align_rings() if the count is not 64. Without a table (nullptr)
/// fails with kUnsupported for such a scan.
[[nodiscard]] Status recover_rings(std::span<const ScanPoint> points, const RingTable* table,
                                   RingRecovery& recovery);

}  // namespace terracut::scan
