// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "moved_cloud.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <span>
#include <string_view>

#include "terracut/segmenter.hpp"

namespace terracut::dds {
namespace {

/// A coordinate in the bytes of a point.
struct Coordinate {
  std::uint32_t offset = 0;
  FieldType type{};
};

template <class T>
T swapped_if(bool swapped, T value) noexcept {
  auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(T)>>(value);
  if (swapped) std::ranges::reverse(bytes);
  return std::bit_cast<T>(bytes);
}

template <class T>
double number_at(const std::uint8_t* at, bool swapped) noexcept {
  T value;
  std::memcpy(&value, at, sizeof value);
  return swapped_if(swapped, value);
}

template <class T>
void put_number(double number, std::uint8_t* at, bool swapped) noexcept {
  const T value = swapped_if(swapped, static_cast<T>(number));
  std::memcpy(at, &value, sizeof value);
}

Coordinate coordinate_of(const RosCloud& cloud, std::string_view name) noexcept {
  for (const auto& field : std::span(cloud.fields._buffer, cloud.fields._length)) {
    if (field.name == name) return {field.offset, static_cast<FieldType>(field.datatype)};
  }
  return {};
}

std::array<Coordinate, 3> coordinates_of(const RosCloud& cloud) noexcept {
  return {coordinate_of(cloud, "x"), coordinate_of(cloud, "y"), coordinate_of(cloud, "z")};
}

}  // namespace

bool MovedCloud::can_move(const RosCloud& cloud) noexcept {
  return std::ranges::all_of(coordinates_of(cloud), [](const Coordinate& one) {
    return one.type == FieldType::kFloat32 || one.type == FieldType::kFloat64;
  });
}

const RosCloud& MovedCloud::move(const RosCloud& from, const mount::RigidTransform& T_to_from,
                                 const std::string& frame) {
  data_.assign(from.data._buffer, from.data._buffer + from.data._length);
  frame_ = frame;
  cloud_ = from;
  cloud_.header.frame_id = frame_.data();
  cloud_.data._buffer = data_.data();
  const bool swapped = from.is_bigendian;
  const std::array<Coordinate, 3> coordinates = coordinates_of(from);
  for (std::size_t row = 0; row < from.height; ++row) {
    std::uint8_t* point = data_.data() + (point_of(from, row, 0) - from.data._buffer);
    for (std::size_t column = 0; column < from.width; ++column, point += from.point_step) {
      std::array<double, 3> at_m{};
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [offset, type] = coordinates[i];
        at_m[i] = type == FieldType::kFloat32 ? number_at<float>(point + offset, swapped)
                                              : number_at<double>(point + offset, swapped);
      }
      at_m = mount::apply(T_to_from, at_m[0], at_m[1], at_m[2]);
      for (std::size_t i = 0; i < 3; ++i) {
        const auto [offset, type] = coordinates[i];
        if (type == FieldType::kFloat32) {
          put_number<float>(at_m[i], point + offset, swapped);
        } else {
          put_number<double>(at_m[i], point + offset, swapped);
        }
      }
    }
  }
  return cloud_;
}

}  // namespace terracut::dds
