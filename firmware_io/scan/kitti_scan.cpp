// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/kitti_scan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "firmware_io/scan/label_file.hpp"
#include "rt/files/record_file.hpp"

namespace terracut::scan {

Status read_kitti_scan(const std::filesystem::path& bin_file, KittiScan& scan) {
  static_assert(sizeof(ScanPoint) == 16);
  const files::RecordLayout layout{"point of 4 float32 (x y z remission)", sizeof(ScanPoint),
                                   kMaxScanPoints};
  scan.labels.clear();
  scan.no_place = 0;
  if (const Status status = files::read_records(bin_file, layout, scan.points); !status)
    return status;
  scan.no_place = static_cast<std::size_t>(std::count_if(
      scan.points.begin(), scan.points.end(), [](const ScanPoint& p) { return !is_place(p); }));
  if (scan.no_place == scan.points.size()) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: none of the {} points is finite and not null; expected float32 x "
                            "y z remission",
                            bin_file.string(), scan.points.size()));
  }
  return {};
}

Status read_kitti_scan(const std::filesystem::path& bin_file,
                       const std::filesystem::path& label_file, KittiScan& scan) {
  if (const Status status = read_kitti_scan(bin_file, scan); !status) return status;
  return read_label_file(label_file, scan.points.size(), scan.labels);
}

}  // namespace terracut::scan
