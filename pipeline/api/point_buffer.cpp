// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/api/point_buffer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <initializer_list>
#include <string>
#include <utility>

namespace terracut {
namespace {

constexpr std::array<std::size_t, 9> kBytes{0, 1, 1, 2, 2, 4, 4, 4, 8};  // indexed by FieldType

std::size_t bytes_of(FieldType type) noexcept {
  const auto number = static_cast<std::size_t>(type);
  return number < kBytes.size() ? kBytes[number] : 0;
}

template <class T>
float value_at(const std::byte* at, bool swapped) noexcept {
  static_assert(std::endian::native == std::endian::little, "big-endian values are turned round");
  std::array<std::byte, sizeof(T)> bytes;
  std::memcpy(bytes.data(), at, sizeof(T));
  if (swapped) std::ranges::reverse(bytes);
  return static_cast<float>(std::bit_cast<T>(bytes));
}

float value_at(const std::byte* at, FieldType type, bool swapped) noexcept {
  switch (type) {
    case FieldType::kInt8:
      return value_at<std::int8_t>(at, swapped);
    case FieldType::kUint8:
      return value_at<std::uint8_t>(at, swapped);
    case FieldType::kInt16:
      return value_at<std::int16_t>(at, swapped);
    case FieldType::kUint16:
      return value_at<std::uint16_t>(at, swapped);
    case FieldType::kInt32:
      return value_at<std::int32_t>(at, swapped);
    case FieldType::kUint32:
      return value_at<std::uint32_t>(at, swapped);
    case FieldType::kFloat32:
      return value_at<float>(at, swapped);
    case FieldType::kFloat64:
      return value_at<double>(at, swapped);
  }
  return 0;
}

const PointField* any_of(const PointBuffer& buffer, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    const auto found = std::ranges::find(buffer.fields, name, &PointField::name);
    if (found != buffer.fields.end()) return &*found;
  }
  return nullptr;
}

using Read = tl::expected<void, RefusedBuffer>;

tl::unexpected<RefusedBuffer> refused(BufferFault fault, std::string message) {
  return tl::unexpected<RefusedBuffer>(RefusedBuffer{fault, std::move(message)});
}

Read check_fields(const PointBuffer& buffer) {
  for (const PointField& field : buffer.fields) {
    const std::size_t bytes = bytes_of(field.type);
    if (bytes == 0) {
      return refused(BufferFault::kUnknownType,
                     fmt::format("field {} has type {}; known are 1 to 8", field.name,
                                 static_cast<int>(field.type)));
    }
    // Divides instead of multiplying: a product of these values could overflow.
    const std::size_t count = std::max<std::size_t>(field.count, 1);
    if (field.offset < buffer.point_step && count <= (buffer.point_step - field.offset) / bytes) {
      continue;
    }
    return refused(BufferFault::kBeyondPoint,
                   fmt::format("field {}, {} of type {} at byte {}, does not lie in a point of {} "
                               "bytes",
                               field.name, count, static_cast<int>(field.type), field.offset,
                               buffer.point_step));
  }
  return {};
}

/// Requires `point_step` > 0, which holds if the fields lie within a point.
Read check_sizes(const PointBuffer& buffer, std::size_t row_step) {
  if (buffer.width == 0 || buffer.height == 0) {
    return refused(BufferFault::kNoPoints,
                   fmt::format("{} rows of {} points", buffer.height, buffer.width));
  }
  if (buffer.width > scan::kMaxScanPoints / buffer.height) {
    return refused(BufferFault::kTooManyPoints,
                   fmt::format("{} rows of {} points; a frame has at most {}", buffer.height,
                               buffer.width, scan::kMaxScanPoints));
  }
  const bool fits = buffer.width <= row_step / buffer.point_step &&
                    row_step <= buffer.data.size() / buffer.height;
  if (fits) return {};
  return refused(
      BufferFault::kSizes,
      fmt::format("{} bytes do not hold {} rows of {} points, {} bytes from point to point "
                  "and {} from row to row",
                  buffer.data.size(), buffer.height, buffer.width, buffer.point_step, row_step));
}

}  // namespace

Read unpack(const PointBuffer& buffer, cloud::Cloud& cloud) {
  const PointField *x = any_of(buffer, {"x"}), *y = any_of(buffer, {"y"}),
                   *z = any_of(buffer, {"z"});
  if (x == nullptr || y == nullptr || z == nullptr) {
    return refused(BufferFault::kNoPosition, "a point has no field x, y or z");
  }
  const std::size_t row_step =
      buffer.row_step != 0 ? buffer.row_step : buffer.width * buffer.point_step;
  if (Read good = check_fields(buffer); !good) return good;
  if (Read good = check_sizes(buffer, row_step); !good) return good;

  const PointField* laser = any_of(buffer, {"ring", "channel", "laser", "row"});
  const PointField* intensity = any_of(buffer, {"intensity", "remission", "reflectivity"});
  cloud.points.resize(buffer.width * buffer.height);
  cloud.laser.resize(laser != nullptr ? cloud.points.size() : 0);
  cloud.rows = buffer.height;
  // Drivers write the sensor's intensity, 0..255; pictures need 0..1, or they would stay dark.
  constexpr float kPerStep = 1.0F / 255;
  const auto value_of = [&](const std::byte* point, const PointField& field) {
    return value_at(point + field.offset, field.type, buffer.big_endian);
  };
  std::size_t i = 0;
  for (std::size_t row = 0; row < buffer.height; ++row) {
    const std::byte* point = buffer.data.data() + row * row_step;
    for (std::size_t column = 0; column < buffer.width; ++column, point += buffer.point_step, ++i) {
      cloud.points[i] = {value_of(point, *x), value_of(point, *y), value_of(point, *z),
                         intensity == nullptr ? 0.0F : value_of(point, *intensity) * kPerStep};
      if (laser == nullptr) continue;
      const float number = value_of(point, *laser);
      const bool is_laser = number >= 0 && number < float{cloud::kMostLasers};
      // Only points with a valid position count: drivers write any number where a beam had no
      // return.
      if (!is_laser && scan::is_place(cloud.points[i])) {
        return refused(BufferFault::kLaserNumber,
                       fmt::format("{} of point {} is {}; expected 0 to {}", laser->name, i, number,
                                   cloud::kMostLasers - 1));
      }
      cloud.laser[i] = is_laser ? static_cast<std::uint16_t>(number) : std::uint16_t{0};
    }
  }
  return {};
}

}  // namespace terracut
