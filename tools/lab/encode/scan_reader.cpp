// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/encode/scan_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "firmware_io/scan/ring_fit_of_scans.hpp"
#include "tools/lab/encode/motion_compensation.hpp"

namespace terracut::encode {
namespace {

Error in_file(const std::filesystem::path& path, Error error) {
  error.message = path.string() + ": " + error.message;
  return error;
}

/// Returns what the folder lacks for the scans' motion; empty if it lacks nothing.
std::string missing_for_motion(const scan::ScanFolder& folder) {
  if (!folder.poses) return "poses.txt is missing beside velodyne/";
  if (!folder.times) return "times.txt is missing beside velodyne/";
  const auto unnumbered = std::ranges::find_if(
      folder.scans, [](const scan::ScanFile& scan) { return !scan.frame.has_value(); });
  if (unnumbered == folder.scans.end()) return {};
  return fmt::format("{} is not named by its frame number, like 000042.bin, to find its pose",
                     unnumbered->points.string());
}

}  // namespace

Expected<ScanReader> ScanReader::open(const std::filesystem::path& folder, PutMotionBack put_back) {
  auto listed = scan::list_scan_folder(folder);
  if (!listed) return tl::unexpected(std::move(listed.error()));
  ScanReader reader;
  reader.folder_ = std::move(*listed);
  if (put_back == PutMotionBack::kNever) {
    reader.why_as_recorded_ = "so it was asked for";
    return reader;
  }
  const scan::ScanFolder& found = reader.folder_;
  reader.why_as_recorded_ = missing_for_motion(found);
  if (reader.why_as_recorded_.empty()) {
    auto motion = SensorMotion::read(*found.poses, *found.times, found.calib);
    if (!motion) return tl::unexpected(std::move(motion.error()));
    const auto beyond = std::ranges::find_if(
        found.scans, [&](const scan::ScanFile& scan) { return *scan.frame >= motion->frames(); });
    if (beyond == found.scans.end()) {
      reader.motion_ = std::move(*motion);
      return reader;
    }
    reader.why_as_recorded_ = fmt::format("{} ends at frame {}, before {}", found.poses->string(),
                                          motion->frames() - 1, beyond->points.string());
  }
  return reader;
}

Status ScanReader::read(std::size_t index, scan::KittiScan& scan, scan::RingRecovery& rings) const {
  return read(index, table_ ? &*table_ : nullptr, scan, rings);
}

Status ScanReader::read(std::size_t index, const scan::RingTable* table, scan::KittiScan& scan,
                        scan::RingRecovery& rings) const {
  const scan::ScanFile& file = folder_.scans[index];
  const Status status = file.labels ? scan::read_kitti_scan(file.points, *file.labels, scan)
                                    : scan::read_kitti_scan(file.points, scan);
  if (!status) return status;
  // Rings are found first: restoring the motion moves points across the line that separates rings.
  Status recovered = scan::recover_rings(scan.points, table, rings);
  if (!recovered) return tl::unexpected(in_file(file.points, std::move(recovered.error())));
  const auto twist = this->twist(index);
  if (!twist) return tl::unexpected(twist.error());
  if (*twist) undo_motion_compensation(**twist, scan.points);
  return {};
}

Expected<std::optional<SensorTwist>> ScanReader::twist(std::size_t index) const {
  if (!motion_) return std::nullopt;
  const auto twist = motion_->twist(folder_.scans[index].frame.value());
  if (!twist) return tl::unexpected(twist.error());
  return *twist;
}

Expected<scan::FittedRings> ScanReader::fit_rings() {
  scan::KittiScan scan;
  scan::RingRecovery rings;
  auto fitted = scan::fit_rings_of_scans(
      size(), [&](std::size_t index, const scan::RingTable* table, scan::RingTableFit& fit) {
        Status status = read(index, table, scan, rings);
        if (status) fit.add(scan.points, rings.ring_of_point);
        return status;
      });
  if (fitted) table_ = fitted->table;
  return fitted;
}

}  // namespace terracut::encode
