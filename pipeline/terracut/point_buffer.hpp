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

/// A driver's memory, as the library and `terracut node` read it; not installed.
namespace terracut {

/// Why it holds no cloud.
enum class BufferFault : std::uint8_t {
  kNoPosition,   ///< A field x, y or z is missing.
  kUnknownType,  ///< A field's type is none of FieldType.
  kBeyondPoint,  ///< A field ends behind its point.
  kNoPoints,
  kTooManyPoints,  ///< More than scan::kMaxScanPoints.
  kSizes,          ///< Width, height and steps ask for more bytes than there are.
  kLaserNumber,    ///< That of a return is no whole number from 0 to 255.
  kCount,
};

/// Stable lower_snake_case name, as in reports; "unknown" for anything else.
[[nodiscard]] constexpr std::string_view to_string(BufferFault fault) noexcept {
  constexpr std::array<std::string_view, static_cast<std::size_t>(BufferFault::kCount)> kNames{
      "no_position",     "unknown_type", "field_beyond_point", "no_points",
      "too_many_points", "wrong_sizes",  "laser_number"};
  return fault < BufferFault::kCount ? kNames[static_cast<std::size_t>(fault)] : "unknown";
}

struct RefusedBuffer {
  BufferFault fault;
  std::string message;  ///< What was expected, what was found.
};

/// Takes the points out of a driver's memory into `cloud`, whose buffers are reused.
[[nodiscard]] tl::expected<void, RefusedBuffer> unpack(const PointBuffer& buffer,
                                                       cloud::Cloud& cloud);

}  // namespace terracut
