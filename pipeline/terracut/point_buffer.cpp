// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/terracut/point_buffer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <initializer_list>
#include <optional>

namespace terracut {
namespace {

constexpr std::array<std::size_t, 9> kBytes{0, 1, 1, 2, 2, 4, 4, 4, 8};  // by FieldType

std::size_t bytes_of(FieldType type) noexcept {
  const auto number = static_cast<std::size_t>(type);
  return number < kBytes.size() ? kBytes[number] : 0;
}

template <class T>
float value_at(const std::byte* at) noexcept {
  static_assert(std::endian::native == std::endian::little, "values are used as they stand");
  T value;
  std::memcpy(&value, at, sizeof(T));
  return static_cast<float>(value);
}

float value_at(const std::byte* at, FieldType type) noexcept {
  switch (type) {
    case FieldType::kInt8:
      return value_at<std::int8_t>(at);
    case FieldType::kUint8:
      return value_at<std::uint8_t>(at);
    case FieldType::kInt16:
      return value_at<std::int16_t>(at);
    case FieldType::kUint16:
      return value_at<std::uint16_t>(at);
    case FieldType::kInt32:
      return value_at<std::int32_t>(at);
    case FieldType::kUint32:
      return value_at<std::uint32_t>(at);
    case FieldType::kFloat32:
      return value_at<float>(at);
    case FieldType::kFloat64:
      return value_at<double>(at);
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

Status check(const PointBuffer& buffer, std::size_t row_step) {
  for (const PointField& field : buffer.fields) {
    const std::size_t bytes = bytes_of(field.type);
    if (bytes > 0 && buffer.point_step >= bytes && field.offset <= buffer.point_step - bytes) {
      continue;
    }
    return fail(
        ErrorCode::kMalformed,
        fmt::format("field {} of type {} at byte {} does not lie in a point of {} bytes",
                    field.name, static_cast<int>(field.type), field.offset, buffer.point_step));
  }
  const bool fits = buffer.width > 0 && buffer.height > 0 &&
                    buffer.width <= scan::kMaxScanPoints / buffer.height &&
                    buffer.width <= row_step / buffer.point_step &&
                    row_step <= buffer.data.size() / buffer.height;
  if (fits) return {};
  return fail(
      ErrorCode::kMalformed,
      fmt::format("{} bytes do not hold {} rows of {} points, {} bytes from point to point "
                  "and {} from row to row",
                  buffer.data.size(), buffer.height, buffer.width, buffer.point_step, row_step));
}

}  // namespace

Status unpack(const PointBuffer& buffer, cloud::Cloud& cloud) {
  const PointField *x = any_of(buffer, {"x"}), *y = any_of(buffer, {"y"}),
                   *z = any_of(buffer, {"z"});
  if (x == nullptr || y == nullptr || z == nullptr) {
    return fail(ErrorCode::kMalformed, "a point has no field x, y or z");
  }
  const std::size_t row_step =
      buffer.row_step != 0 ? buffer.row_step : buffer.width * buffer.point_step;
  if (Status good = check(buffer, row_step); !good) return good;

  const PointField* laser = any_of(buffer, {"ring", "channel", "laser", "row"});
  const PointField* intensity = any_of(buffer, {"intensity", "remission", "reflectivity"});
  cloud.points.resize(buffer.width * buffer.height);
  cloud.laser.resize(laser != nullptr ? cloud.points.size() : 0);
  cloud.rows = buffer.height;
  // Drivers give intensity as the sensor's 0..255; 0..1 then stays dark in pictures.
  constexpr float kPerStep = 1.0F / 255;
  std::size_t i = 0;
  for (std::size_t row = 0; row < buffer.height; ++row) {
    const std::byte* point = buffer.data.data() + row * row_step;
    for (std::size_t column = 0; column < buffer.width; ++column, point += buffer.point_step, ++i) {
      cloud.points[i] = {value_at(point + x->offset, x->type), value_at(point + y->offset, y->type),
                         value_at(point + z->offset, z->type),
                         intensity == nullptr
                             ? 0.0F
                             : value_at(point + intensity->offset, intensity->type) * kPerStep};
      if (laser == nullptr) continue;
      const float number = value_at(point + laser->offset, laser->type);
      if (!(number >= 0 && number < float{cloud::kMostLasers})) {
        return fail(ErrorCode::kMalformed,
                    fmt::format("{} of point {} is {}; expected 0 to {}", laser->name, i, number,
                                cloud::kMostLasers - 1));
      }
      cloud.laser[i] = static_cast<std::uint16_t>(number);
    }
  }
  return {};
}

}  // namespace terracut
