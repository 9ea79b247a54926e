// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware_io/bag/cdr_reader.hpp"
#include "terracut/segmenter.hpp"

namespace terracut::ros_messages {

/// A sensor_msgs/PointCloud2 as its message holds it: a view, without checks of what it says of its
/// points, which terracut::unpack() makes.
struct CloudMessage {
  bag::Header header;
  std::vector<PointField> fields;
  PointBuffer buffer;  ///< Its fields are those above.

  CloudMessage() = default;
  CloudMessage(const CloudMessage&) = delete;
  CloudMessage& operator=(const CloudMessage&) = delete;

  /// Reads a message, which must outlive this object. False if it is broken.
  [[nodiscard]] bool read(std::span<const std::byte> message) {
    bag::CdrReader from(message);
    header = bag::Header::read(from);
    buffer = {};
    buffer.height = from.number<std::uint32_t>();
    buffer.width = from.number<std::uint32_t>();
    constexpr std::size_t kLeastFieldBytes = 13;
    fields.clear();
    for (std::size_t left = from.length(kLeastFieldBytes); left > 0; --left) {
      PointField& field = fields.emplace_back();
      field.name = from.text();
      field.offset = from.number<std::uint32_t>();
      field.type = static_cast<FieldType>(from.number<std::uint8_t>());
      field.count = from.number<std::uint32_t>();
    }
    buffer.big_endian = from.number<std::uint8_t>() != 0;
    buffer.point_step = from.number<std::uint32_t>();
    buffer.row_step = from.number<std::uint32_t>();
    buffer.data = from.byte_sequence();
    buffer.fields = fields;
    return !from.failed();
  }
};

}  // namespace terracut::ros_messages
