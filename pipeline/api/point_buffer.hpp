// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "firmware_io/cloud/cloud.hpp"
#include "terracut/segmenter.hpp"

/// Reads clouds in a driver's memory, for the library and `terracut node`; not installed.
namespace terracut {

/// Why a buffer is not a valid cloud.
enum class BufferFault : std::uint8_t {
  kNoPosition,   ///< The field x, y or z is missing.
  kUnknownType,  ///< The type of a field is not a FieldType.
  kBeyondPoint,  ///< A field ends beyond the point's last byte.
  kNoPoints,
  kTooManyPoints,  ///< The cloud has more than scan::kMaxScanPoints points.
  kSizes,          ///< Width, height and steps ask for more bytes than there are.
  kLaserNumber,    ///< A point's laser number is not a whole number from 0 to 255.
  kCount,
};

/// Returns a stable lower_snake_case name for reports; "unknown" for an invalid value.
[[nodiscard]] constexpr std::string_view to_string(BufferFault fault) noexcept {
  constexpr std::array<std::string_view, static_cast<std::size_t>(BufferFault::kCount)> kNames{
      "no_position",     "unknown_type", "field_beyond_point", "no_points",
      "too_many_points", "wrong_sizes",  "laser_number"};
  return fault < BufferFault::kCount ? kNames[static_cast<std::size_t>(fault)] : "unknown";
}

struct RefusedBuffer {
  BufferFault fault;
  std::string message;  ///< States what was expected and what was found.
};

/// Copies the points of a driver's memory into `cloud`, reusing the memory of `cloud`.
[[nodiscard]] tl::expected<void, RefusedBuffer> unpack(const PointBuffer& buffer,
                                                       cloud::Cloud& cloud);

}  // namespace terracut
