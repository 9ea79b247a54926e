// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/cloud/cloud_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "firmware_io/cloud/field_table.hpp"
#include "firmware_io/cloud/pcd_file.hpp"
#include "firmware_io/cloud/ply_file.hpp"
#include "rt/files/ending.hpp"
#include "rt/files/record_file.hpp"

namespace terracut::cloud {
namespace {

namespace fs = std::filesystem;

using Values = std::optional<std::span<const double>>;

Values any_of(const FieldTable& table, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    if (const Values values = table.field(name)) return values;
  }
  return std::nullopt;
}

/// Drivers give intensity as 0..1 or as the sensor's 0..255.
float remission_scale(float brightest) noexcept {
  return brightest > 1.0F ? 1.0F / 255 : 1.0F;
}

Status take_laser(const fs::path& path, std::size_t point, double number, Cloud& cloud) {
  if (!(number >= 0 && number < kMostLasers) || number != std::floor(number)) {
    return fail(ErrorCode::kMalformed,
                fmt::format("{}: ring of point {} is {}; expected a whole number from 0 to {}",
                            path.string(), point, number, kMostLasers - 1));
  }
  cloud.laser.push_back(static_cast<std::uint16_t>(number));
  return {};
}

Status take_table(const fs::path& path, const FieldTable& table, Cloud& cloud) {
  const Values x = table.field("x"), y = table.field("y"), z = table.field("z");
  if (!x || !y || !z) {
    return fail(ErrorCode::kMalformed, fmt::format("{}: expected the fields x, y and z; it has: {}",
                                                   path.string(), fmt::join(table.names, " ")));
  }
  const Values intensity = any_of(table, {"intensity", "remission", "reflectivity"});
  const Values laser = any_of(table, {"ring", "channel", "laser", "row"});
  for (std::size_t i = 0; laser && i < table.points; ++i) {
    if (Status taken = take_laser(path, i, (*laser)[i], cloud); !taken) return taken;
  }
  float scale = 1;
  if (intensity) scale = remission_scale(static_cast<float>(std::ranges::max(*intensity)));
  for (std::size_t i = 0; i < table.points; ++i) {
    cloud.points.push_back({static_cast<float>((*x)[i]), static_cast<float>((*y)[i]),
                            static_cast<float>((*z)[i]),
                            intensity ? static_cast<float>((*intensity)[i]) * scale : 0.0F});
  }
  cloud.rows = table.rows;
  return {};
}

Status read_table(const fs::path& path, const Expected<FieldTable>& table, Cloud& cloud) {
  if (!table) return tl::unexpected(table.error());
  return take_table(path, *table, cloud);
}

Status read_kitti(const fs::path& path, Cloud& cloud) {
  return files::read_records(
      path, {"point of 4 float32 (x y z remission)", sizeof(scan::ScanPoint), scan::kMaxScanPoints},
      cloud.points);
}

Status read_by_name(const fs::path& path, Cloud& cloud) {
  const std::string ending = files::ending_of(path);
  if (ending == ".pcd") return read_table(path, read_pcd(path), cloud);
  if (ending == ".ply") return read_table(path, read_ply(path), cloud);
  if (ending != ".bin") {
    return fail(ErrorCode::kUnsupported,
                path.string() + ": expected a cloud: .bin, .pcd.bin, .pcd or .ply");
  }
  return files::ending_of(path.stem()) == ".pcd" ? read_nuscenes_bin(path, cloud)
                                                 : read_kitti(path, cloud);
}

}  // namespace

bool is_cloud_file(const fs::path& path) {
  const std::string ending = files::ending_of(path);
  return ending == ".bin" || ending == ".pcd" || ending == ".ply";
}

Status read_nuscenes_bin(const fs::path& path, Cloud& cloud) {
  struct Record {
    float x_m, y_m, z_m, intensity, ring;
  };
  cloud.points.clear();
  cloud.laser.clear();
  cloud.rows = 1;
  std::vector<Record> records;
  const Status read = files::read_records(
      path, {"point of 5 float32 (x y z intensity ring)", sizeof(Record), scan::kMaxScanPoints},
      records);
  if (!read) return read;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const Record& record = records[i];
    cloud.points.push_back({record.y_m, -record.x_m, record.z_m, record.intensity / 255});
    if (Status taken = take_laser(path, i, double{record.ring}, cloud); !taken) return taken;
  }
  return {};
}

Status read_cloud(const fs::path& path, Cloud& cloud) {
  cloud.points.clear();
  cloud.laser.clear();
  cloud.rows = 1;
  if (Status read = read_by_name(path, cloud); !read) return read;
  if (std::ranges::any_of(cloud.points, scan::is_place)) return {};
  return fail(ErrorCode::kMalformed, fmt::format("{}: none of the {} points is finite and not null",
                                                 path.string(), cloud.points.size()));
}

}  // namespace terracut::cloud
