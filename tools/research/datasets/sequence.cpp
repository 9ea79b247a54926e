// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sequence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "firmware_io/scan/ring_fit_of_scans.hpp"

namespace terracut::datasets {

namespace fs = std::filesystem;

Expected<Sequence> Sequence::open(const CloudLayout& layout, fs::path folder) {
  Sequence sequence;
  sequence.layout_ = layout;
  sequence.folder_ = std::move(folder);
  sequence.frames_ = layout.points.names_in(sequence.folder_);
  if (sequence.frames_.empty()) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: no {} in it", sequence.folder_.string(), layout.points.text()));
  }
  const bool by_laser = layout.rings_from == RingSource::kField;
  const Status fitted = by_laser ? sequence.fit_lasers() : sequence.fit_rings();
  if (!fitted) return tl::unexpected(fitted.error());
  return sequence;
}

Status Sequence::read(std::size_t index, const scan::RingTable* table, LabelledScan& scan) const {
  if (const Status read = read_points(layout_, file(index), scan); !read) return read;
  if (layout_.rings_from == RingSource::kField) {
    find_rings(ring_of_laser_, scan);
    return {};
  }
  Status recovered = scan::recover_rings(scan.scan.points, table, scan.rings);
  if (!recovered) {
    recovered.error().message = file(index).string() + ": " + recovered.error().message;
  }
  return recovered;
}

Status Sequence::read(std::size_t index, LabelledScan& scan) const {
  if (const Status read = this->read(index, &table_, scan); !read) return read;
  if (scan.rings.no_ring == scan.scan.points.size()) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: of none of its {} points the laser could be told; is it a scan of "
                            "a sensor with 64 rings, in the order of the original KITTI files?",
                            file(index).string(), scan.scan.points.size()));
  }
  if (!layout_.labels) return {};
  const fs::path labels = folder_ / layout_.labels->path(frames_[index]);
  std::error_code error;
  if (!fs::exists(fs::symlink_status(labels, error))) {
    return fail(ErrorCode::kNotFound, file(index).string() + ": there is no label file for it");
  }
  return read_labels(layout_.label_format, labels, scan.scan);
}

Status Sequence::check_whole() const {
  if (!layout_.labels) return {};
  std::vector<std::string> without;
  std::ranges::set_difference(layout_.labels->names_in(folder_), frames_,
                              std::back_inserter(without));
  if (without.empty()) return {};
  return fail(ErrorCode::kMalformed,
              fmt::format("{}: there is no scan for it{}",
                          (folder_ / layout_.labels->path(without.front())).string(),
                          without.size() == 1 ? std::string()
                                              : fmt::format(", nor for {} more labels beside it",
                                                            without.size() - 1)));
}

Status Sequence::fit_rings() {
  LabelledScan scan;
  auto fitted = scan::fit_rings_of_scans(
      size(), [&](std::size_t index, const scan::RingTable* table, scan::RingTableFit& fit) {
        Status read = this->read(index, table, scan);
        if (!read) return read;
        fit.add(scan.scan.points, scan.rings.ring_of_point);
        spin_.add(scan.rings.ring_of_point);
        return read;
      });
  if (!fitted) return tl::unexpected(fitted.error());
  table_ = std::move(fitted->table);
  return {};
}

Status Sequence::fit_lasers() {
  // Far beyond noise and motion, far below what a map's frame or wrong numbers do.
  constexpr double kWidestCone_m = 1.0;
  LabelledScan scan;
  LaserElevations elevations(layout_.rings);
  const Status looked = scan::read_some_scans(size(), [&](std::size_t index) {
    Status read = read_points(layout_, file(index), scan);
    if (read) elevations.add(scan);
    return read;
  });
  if (!looked) return looked;
  ring_of_laser_ = elevations.order();

  scan::RingTableFit fit(layout_.rings);
  const Status read = scan::read_some_scans(size(), [&](std::size_t index) {
    Status one = this->read(index, nullptr, scan);
    if (!one) return one;
    fit.add(scan.scan.points, scan.rings.ring_of_point);
    spin_.add(scan.rings.ring_of_point);
    return one;
  });
  if (!read) return read;
  // Lasers of an HDL-64E start up to 0.2 m above the origin, those of other sensors next to it.
  // Their lowest ones see little but near ground, which would not tell offset and elevation apart.
  const scan::RingTable from_origin(static_cast<std::size_t>(layout_.rings));
  auto fitted = fit.fit(layout_.rings == scan::kScanRings ? nullptr : &from_origin);
  if (!fitted) return tl::unexpected(fitted.error());
  if (fitted->residual.p95_m > kWidestCone_m) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: the points of a laser do not lie on a cone around the origin "
                            "(5 % of them are off by more than {:.1f} m): expected are points in "
                            "the sensor's own frame, one revolution a file, and the laser of each",
                            folder_.string(), fitted->residual.p95_m));
  }
  table_ = std::move(fitted->table);
  return {};
}

}  // namespace terracut::datasets
