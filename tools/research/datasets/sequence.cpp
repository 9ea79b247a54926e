// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "sequence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "firmware_io/scan/ring_fit_of_scans.hpp"

namespace terracut::datasets {

namespace fs = std::filesystem;
namespace {

/// Sets `scan.rings` from the laser numbers of the points.
void find_rings(const cloud::RingOfLaser& ring_of_laser, LabelledScan& scan) {
  scan::RingRecovery& rings = scan.rings;
  std::vector<bool> met(ring_of_laser.size());
  rings = {.ring_of_point = std::move(rings.ring_of_point)};
  rings.ring_of_point.resize(scan.scan.points.size());
  for (std::size_t i = 0; i < scan.scan.points.size(); ++i) {
    const std::size_t laser = scan.laser_of_point[i];
    const std::int16_t ring =
        scan::is_place(scan.scan.points[i]) ? ring_of_laser[laser] : scan::kNoRing;
    rings.ring_of_point[i] = ring;
    if (ring == scan::kNoRing) {
      ++rings.no_ring;
    } else {
      met[laser] = true;
    }
  }
  rings.rings = static_cast<int>(std::ranges::count(met, true));
}

}  // namespace

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
  LabelledScan scan;
  auto fitted =
      cloud::fit_numbered_lasers(static_cast<std::size_t>(layout_.rings), size(),
                                 [&](std::size_t index) -> Expected<cloud::CloudView> {
                                   const Status read = read_points(layout_, file(index), scan);
                                   if (!read) return tl::unexpected(read.error());
                                   return cloud::CloudView{scan.scan.points, scan.laser_of_point};
                                 });
  if (!fitted) {
    // An error of reading a file names that file already.
    const bool of_file = fitted.error().message.starts_with(folder_.string());
    return fail(fitted.error().code,
                (of_file ? "" : folder_.string() + ": ") + fitted.error().message);
  }
  ring_of_laser_ = std::move(fitted->ring_of_laser);
  table_ = std::move(fitted->rings.table);
  return scan::read_some_scans(size(), [&](std::size_t index) {
    Status read = this->read(index, nullptr, scan);
    if (read) spin_.add(scan.rings.ring_of_point);
    return read;
  });
}

}  // namespace terracut::datasets
