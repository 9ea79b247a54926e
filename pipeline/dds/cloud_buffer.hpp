// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <vector>

#include "derived_cloud.hpp"
#include "terracut/segmenter.hpp"

namespace terracut::dds {

/// Returns a view of `cloud` as the library's PointBuffer, without checks. The view's fields are
/// stored in `fields`, which must live as long as the view.
[[nodiscard]] inline PointBuffer point_buffer_of(const RosCloud& cloud,
                                                 std::vector<PointField>& fields) {
  fields.clear();
  for (const auto& field : std::span(cloud.fields._buffer, cloud.fields._length)) {
    fields.push_back(
        {field.name, field.offset, static_cast<FieldType>(field.datatype), field.count});
  }
  return {std::as_bytes(std::span(cloud.data._buffer, cloud.data._length)),
          fields,
          cloud.point_step,
          cloud.width,
          cloud.height,
          cloud.row_step,
          cloud.is_bigendian};
}

}  // namespace terracut::dds
