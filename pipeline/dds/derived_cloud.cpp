// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "derived_cloud.hpp"

#include <bit>
#include <string_view>

#include "pipeline/output/label_sink.hpp"
#include "terracut/segmenter.hpp"

namespace terracut::dds {
namespace {

// The C type's strings are not const.
char kLabelField[] = "label";
char kHeightField[] = "height_above_ground";

/// Returns the bits of a height as a cloud stores them.
std::uint32_t stored(float height_m, bool is_bigendian) noexcept {
  const auto bits = std::bit_cast<std::uint32_t>(height_m);
  return is_bigendian ? __builtin_bswap32(bits) : bits;
}

}  // namespace

const RosCloud& DerivedCloud::with_labels(const RosCloud& from,
                                          std::span<const frame::Label> labels,
                                          std::span<const float> heights_m) {
  const bool with_height = !heights_m.empty();
  const std::uint32_t own = from.point_step;
  const std::uint32_t labelled = (own + 1 + 3) / 4 * 4;  // keeps floats aligned
  const std::uint32_t step = labelled + (with_height ? std::uint32_t{sizeof(float)} : 0);
  data_.resize(labels.size() * step);
  std::uint8_t* to = data_.data();
  const frame::Label* label = labels.data();
  const float* height_m = heights_m.data();
  for (std::size_t row = 0; row < from.height; ++row) {
    const std::uint8_t* point = point_of(from, row, 0);
    for (std::size_t column = 0; column < from.width; ++column, ++label, point += own, to += step) {
      std::memcpy(to, point, own);
      to[own] = static_cast<std::uint8_t>(output::semantic_kitti_class(*label));
      std::memset(to + own + 1, 0, labelled - own - 1);
      if (!with_height) continue;
      const std::uint32_t height = stored(*height_m++, from.is_bigendian);
      std::memcpy(to + labelled, &height, sizeof height);
    }
  }
  begin(from);
  set_size(from.height, from.width, step);
  cloud_.is_dense = from.is_dense;
  // Fields of these names in the original cloud are replaced.
  std::erase_if(fields_, [&](const auto& field) {
    const std::string_view name = field.name;
    return name == kLabelField || (with_height && name == kHeightField);
  });
  fields_.push_back({kLabelField, own, static_cast<std::uint8_t>(FieldType::kUint8), 1});
  if (with_height) {
    fields_.push_back({kHeightField, labelled, static_cast<std::uint8_t>(FieldType::kFloat32), 1});
  }
  cloud_.fields._buffer = fields_.data();
  cloud_.fields._length = static_cast<std::uint32_t>(fields_.size());
  return cloud_;
}

void DerivedCloud::begin(const RosCloud& from) {
  cloud_.header = from.header;
  fields_.assign(from.fields._buffer, from.fields._buffer + from.fields._length);
  cloud_.fields._buffer = fields_.data();
  cloud_.fields._length = cloud_.fields._maximum = from.fields._length;
  cloud_.is_bigendian = from.is_bigendian;
}

void DerivedCloud::set_size(std::uint32_t height, std::uint32_t width, std::uint32_t point_step) {
  cloud_.height = height;
  cloud_.width = width;
  cloud_.point_step = point_step;
  cloud_.row_step = width * point_step;
  cloud_.data._buffer = data_.data();
  cloud_.data._length = cloud_.data._maximum = height * width * point_step;
}

}  // namespace terracut::dds
