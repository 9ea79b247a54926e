// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/datasets/labelled_scan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "firmware_io/cloud/cloud_file.hpp"
#include "firmware_io/cloud/pcd_file.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "rt/files/record_file.hpp"

namespace terracut::datasets {
namespace {

namespace fs = std::filesystem;
using scan::ScanPoint;

/// Fails unless all values are whole numbers in [0, most].
template <class T>
Status check_whole(std::span<const T> values, const std::string& file, std::string_view name,
                   double most) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto value = static_cast<double>(values[i]);
    if (!(value >= 0 && value <= most) || value != std::floor(value)) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}: {} of point {} is {}; expected a whole number from 0 to {}",
                              file, name, i, value, most));
    }
  }
  return {};
}

Expected<std::span<const double>> whole_numbers(const cloud::FieldTable& cloud,
                                                const std::string& file, std::string_view name,
                                                double most) {
  const auto values = cloud.field(name);
  if (!values) {
    return fail(ErrorCode::kMalformed, fmt::format("{}: there is no field '{}'; it has: {}", file,
                                                   name, fmt::join(cloud.names, " ")));
  }
  const Status whole = check_whole(*values, file, name, most);
  if (!whole) return tl::unexpected(whole.error());
  return *values;
}

Status read_pcd(const CloudLayout& layout, const fs::path& path, LabelledScan& to) {
  const auto cloud = cloud::read_pcd(path);
  if (!cloud) return tl::unexpected(cloud.error());
  const std::string file = path.string();
  const auto x = cloud->field("x"), y = cloud->field("y"), z = cloud->field("z");
  if (!x || !y || !z) {
    return fail(ErrorCode::kMalformed, fmt::format("{}: expected the fields x, y and z; it has: {}",
                                                   file, fmt::join(cloud->names, " ")));
  }
  to.laser_of_point.clear();
  if (layout.rings_from == RingSource::kField) {
    const bool by_ring = !cloud->field("laser") && cloud->field("ring");
    const auto laser = whole_numbers(*cloud, file, by_ring ? "ring" : "laser", layout.rings - 1);
    if (!laser) return tl::unexpected(laser.error());
    to.laser_of_point.assign(laser->begin(), laser->end());
  }
  to.scan.labels.clear();
  if (!layout.labels) {
    const auto label =
        whole_numbers(*cloud, file, "label", std::numeric_limits<std::uint16_t>::max());
    if (!label) return tl::unexpected(label.error());
    to.scan.labels.assign(label->begin(), label->end());
  }
  const auto intensity = cloud->field("intensity");
  to.scan.points.resize(cloud->points);
  for (std::size_t i = 0; i < cloud->points; ++i) {
    to.scan.points[i] = {static_cast<float>((*x)[i]), static_cast<float>((*y)[i]),
                         static_cast<float>((*z)[i]),
                         intensity ? static_cast<float>((*intensity)[i] / 255) : 0.0F};
  }
  return {};
}

Status read_nuscenes_bin(const CloudLayout& layout, const fs::path& path, LabelledScan& to) {
  cloud::Cloud cloud;
  if (Status read = cloud::read_nuscenes_bin(path, cloud); !read) return read;
  to.scan.points = std::move(cloud.points);
  to.laser_of_point.clear();
  if (layout.rings_from != RingSource::kField) return {};
  to.laser_of_point = std::move(cloud.laser);
  return check_whole<std::uint16_t>(to.laser_of_point, path.string(), "ring", layout.rings - 1);
}

Status read_file(const CloudLayout& layout, const fs::path& path, LabelledScan& to) {
  switch (layout.point_format) {
    case PointFormat::kKittiBin:
      to.laser_of_point.clear();
      return scan::read_kitti_scan(path, to.scan);
    case PointFormat::kNuscenesBin:
      return read_nuscenes_bin(layout, path, to);
    case PointFormat::kPcd:
      break;
  }
  return read_pcd(layout, path, to);
}

}  // namespace

Status read_points(const CloudLayout& layout, const fs::path& file, LabelledScan& to) {
  if (const Status read = read_file(layout, file, to); !read) return read;
  const std::vector<ScanPoint>& points = to.scan.points;
  to.scan.no_place = static_cast<std::size_t>(
      std::ranges::count_if(points, [](const ScanPoint& point) { return !scan::is_place(point); }));
  if (to.scan.no_place < points.size()) return {};
  return fail(ErrorCode::kMalformed, file.string() + ": no point is finite");
}

Status read_labels(LabelFormat format, const fs::path& file, scan::KittiScan& to) {
  if (format == LabelFormat::kUint32) {
    return scan::read_label_file(file, to.points.size(), to.labels);
  }
  std::vector<std::uint8_t> bytes;
  const Status read =
      files::read_records(file, {"label of one uint8", 1, scan::kMaxScanPoints}, bytes);
  if (!read) return read;
  to.labels.assign(bytes.begin(), bytes.end());
  if (bytes.size() == to.points.size()) return {};
  return fail(ErrorCode::kMalformed,
              fmt::format("{}: {} labels, but the scan has {} points; expected one label a point",
                          file.string(), bytes.size(), to.points.size()));
}

}  // namespace terracut::datasets
