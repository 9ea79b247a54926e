// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "scan_writer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <tuple>
#include <vector>

#include "firmware_io/scan/kitti_scan.hpp"
#include "firmware_io/scan/label_file.hpp"
#include "labelled_frame.hpp"
#include "rt/files/whole_file.hpp"

namespace terracut::hazards {
namespace {

constexpr std::uint32_t kHazard = 99 | 1U << 16;
constexpr std::uint32_t kUnlabelled = 0;

struct Point {
  int ring = 0;
  double azimuth_rad = 0;  ///< Counter-clockwise from straight ahead, in [0, 2 pi).
  scan::ScanPoint at{};
  std::uint32_t label = 0;
  std::uint32_t index = 0;  ///< Return index.
};

/// Returns the points in the sensor's frame, ring after ring from the top.
std::vector<Point> points_of(const LabelledFrame& frame, const mount::Mount& mount,
                             const MovedReturns& moved) {
  const auto T = mount::T_vehicle_lidar(mount);
  const bool is_upside_down = mount::is_upside_down(mount);
  std::vector<Point> points;
  points.reserve(frame.size());
  auto next = moved.begin();
  for (std::uint32_t i = 0; i < frame.size(); ++i) {
    Point point{.label = frame.class_id[i], .index = i};
    double range_m = frame.range_m[i];
    if (next != moved.end() && next->index == i) {
      range_m = next->range_m;
      point.label = next->counts ? kHazard : kUnlabelled;
      ++next;
    }
    if (range_m <= 0) continue;
    const Eigen::Vector3d way = range_m * frame.beam[i];
    const auto along = [&](std::size_t axis) {
      return T[axis] * way.x() + T[axis + 4] * way.y() + T[axis + 8] * way.z();
    };
    const double x_m = along(0), y_m = along(1);
    point.at = {static_cast<float>(x_m), static_cast<float>(y_m), static_cast<float>(along(2)),
                static_cast<float>(frame.intensity[i]) / 255};
    const int row = frame.cell[i].row;
    point.ring = is_upside_down ? row : frame.shape.rows - 1 - row;
    point.azimuth_rad = std::atan2(y_m, x_m);
    if (point.azimuth_rad < 0) point.azimuth_rad += 2 * std::numbers::pi;
    points.push_back(point);
  }
  std::ranges::sort(points, {}, [](const Point& point) {
    return std::tuple(point.ring, point.azimuth_rad, point.index);
  });
  return points;
}

}  // namespace

void ScanWriter::write(const WrittenScan& scan, const LabelledFrame& frame,
                       const mount::Mount& mount, const MovedReturns& moved) {
  std::vector<scan::ScanPoint> points;
  std::vector<std::uint32_t> labels;
  for (const Point& point : points_of(frame, mount, moved)) {
    points.push_back(point.at);
    labels.push_back(point.label);
  }
  const std::filesystem::path sequence = folder_ / "sequences" / scan.sequence;
  Status written = files::write_whole_file(sequence / "velodyne" / (scan.name + ".bin"),
                                           std::as_bytes(std::span(points)));
  if (written) {
    written = scan::write_label_ids(sequence / "labels" / (scan.name + ".label"), labels);
  }
  const std::scoped_lock lock(mutex_);
  scans_.emplace(scan.sequence + "/" + scan.name, scan);
  if (!written && !failure_) failure_ = written.error();
}

Status ScanWriter::finish() {
  const std::scoped_lock lock(mutex_);
  if (failure_) return tl::unexpected(*failure_);
  nlohmann::ordered_json json{{"scans", nlohmann::ordered_json::array()}};
  for (const auto& [key, scan] : scans_) {
    json["scans"].push_back(
        {{"sequence", scan.sequence}, {"scan", scan.name}, {"what", scan.what}});
    if (scan.ground.empty()) continue;
    json["scans"].back().update(
        {{"ground", scan.ground}, {"from_m", scan.from_m}, {"to_m", scan.to_m}});
  }
  return files::write_whole_file(folder_ / "hazards.json", json.dump(1) + "\n");
}

}  // namespace terracut::hazards
