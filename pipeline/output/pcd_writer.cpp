// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/output/pcd_writer.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "firmware_io/api/points.hpp"
#include "pipeline/output/label_sink.hpp"
#include "rt/files/whole_file.hpp"

namespace terracut::output {
namespace {

static_assert(std::endian::native == std::endian::little, "the record below is written as it lies");

/// The layout of a point on disk, which its height follows: PCD readers compute field offsets from
/// the header's SIZE line.
struct PcdPoint {
  float x_m, y_m, z_m;
  float intensity;
  std::uint16_t ring;
  std::uint16_t label;
};
static_assert(sizeof(PcdPoint) == 20);

constexpr const char* kHeader =
    "# .PCD v0.7 - Point Cloud Data file format\n"
    "VERSION 0.7\n"
    "FIELDS x y z intensity ring label{1}\n"
    "SIZE 4 4 4 4 2 2{2}\n"
    "TYPE F F F F U U{3}\n"
    "COUNT 1 1 1 1 1 1{4}\n"
    "WIDTH {0}\n"
    "HEIGHT 1\n"
    "VIEWPOINT 0 0 0 1 0 0 0\n"
    "POINTS {0}\n"
    "DATA binary\n";

}  // namespace

Status write_pcd(const std::filesystem::path& path, std::span<const Point> points,
                 std::span<const frame::Label> labels, std::span<const float> heights_m) {
  if (labels.size() != points.size()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("a frame of {} returns came with {} labels; expected one a return",
                            points.size(), labels.size()));
  }
  const bool with_height = !heights_m.empty();
  if (with_height && heights_m.size() != points.size()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("a frame of {} returns came with {} heights; expected one a return",
                            points.size(), heights_m.size()));
  }
  std::string content =
      with_height ? fmt::format(kHeader, points.size(), " height_above_ground", " 4", " F", " 1")
                  : fmt::format(kHeader, points.size(), "", "", "", "");
  const std::size_t header_size = content.size();
  const std::size_t step = sizeof(PcdPoint) + (with_height ? sizeof(float) : 0);
  content.resize(header_size + points.size() * step);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PcdPoint point{
        points[i].x_m,  points[i].y_m,
        points[i].z_m,  static_cast<float>(points[i].intensity),
        points[i].ring, static_cast<std::uint16_t>(semantic_kitti_class(labels[i]))};
    char* const to = content.data() + header_size + i * step;
    std::memcpy(to, &point, sizeof(PcdPoint));
    if (with_height) std::memcpy(to + sizeof(PcdPoint), &heights_m[i], sizeof(float));
  }
  return files::write_whole_file(path, content);
}

Status write_pcd(const std::filesystem::path& path, const frame::RangeImage& image,
                 std::span<const frame::Label> labels, std::span<const float> heights_m) {
  std::vector<Point> points(image.returns());
  copy_points(image, points);
  return write_pcd(path, points, labels, heights_m);
}

}  // namespace terracut::output
