// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/sinks/pcd_writer.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>

#include "firmware_io/sinks/each_return.hpp"
#include "firmware_io/sinks/label_sink.hpp"
#include "rt/whole_file.hpp"

namespace terracut::firmware_io {
namespace {

static_assert(std::endian::native == std::endian::little, "the record below is written as it lies");

/// One point on disk; PCD readers take fields at the offsets that the header's SIZE line adds up
/// to.
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
    "FIELDS x y z intensity ring label\n"
    "SIZE 4 4 4 4 2 2\n"
    "TYPE F F F F U U\n"
    "COUNT 1 1 1 1 1 1\n"
    "WIDTH {0}\n"
    "HEIGHT 1\n"
    "VIEWPOINT 0 0 0 1 0 0 0\n"
    "POINTS {0}\n"
    "DATA binary\n";

}  // namespace

Status write_pcd(const std::filesystem::path& path, const pipeline::RangeImage& image,
                 std::span<const pipeline::Label> labels) {
  if (labels.size() != image.returns()) {
    return fail(ErrorCode::kInvalidArgument,
                fmt::format("a frame of {} returns came with {} labels; expected one a return",
                            image.returns(), labels.size()));
  }
  std::string content = fmt::format(kHeader, image.returns());
  const std::size_t header_size = content.size();
  content.resize(header_size + labels.size() * sizeof(PcdPoint));
  for_each_return(image, [&](const PlacedReturn& placed) {
    const PcdPoint point{
        placed.echo.x_m,
        placed.echo.y_m,
        placed.echo.z_m,
        static_cast<float>(placed.echo.intensity),
        static_cast<std::uint16_t>(placed.row),
        static_cast<std::uint16_t>(semantic_kitti_class(labels[placed.return_index]))};
    std::memcpy(content.data() + header_size + placed.return_index * sizeof(PcdPoint), &point,
                sizeof(PcdPoint));
  });
  return rt::write_whole_file(path, content);
}

}  // namespace terracut::firmware_io
