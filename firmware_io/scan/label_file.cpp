// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/scan/label_file.hpp"

#include <fmt/format.h>

#include "firmware_io/scan/kitti_scan.hpp"
#include "rt/files/record_file.hpp"
#include "rt/files/whole_file.hpp"

namespace terracut::scan {

Status read_label_file(const std::filesystem::path& path, std::size_t points,
                       std::vector<std::uint32_t>& labels) {
  const files::RecordLayout layout{"label of one uint32", sizeof(std::uint32_t), kMaxScanPoints};
  if (const Status status = files::read_records(path, layout, labels); !status) return status;
  if (points != 0 && labels.size() != points) {
    return fail(
        ErrorCode::kMalformed,
        fmt::format("{}: {} labels, but the scan has {} points; expected one label a point. "
                    "Do the two files belong to the same frame?",
                    path.string(), labels.size(), points));
  }
  return {};
}

Status write_label_ids(const std::filesystem::path& path, std::span<const std::uint32_t> labels) {
  static_assert(std::endian::native == std::endian::little, "labels are written as they stand");
  return files::write_whole_file(path, std::as_bytes(labels));
}

}  // namespace terracut::scan
