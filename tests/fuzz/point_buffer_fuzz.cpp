// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A cloud as somebody else's PointCloud2 describes it: any fields, any sizes, any bytes, which need
// not fit together. The outcome is a named refusal, or as many points as were promised; and clouds
// that are read are labelled or refused by the library.
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "input.hpp"
#include "pipeline/api/point_buffer.hpp"

namespace {

using namespace terracut;

constexpr std::array<std::string_view, 8> kNames{"x",       "y",         "z",       "ring",
                                                 "channel", "intensity", "azimuth", ""};

/// Small numbers mostly, or any.
std::size_t size_from(fuzz::Input& input) {
  return input.next(1) < 240 ? input.next(1) : input.next(4);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Input input({data, size});
  std::vector<PointField> fields;
  for (int i = input.below(9); i > 0; --i) {
    const std::string_view name = kNames[input.next(1) % kNames.size()];
    const std::size_t offset = size_from(input);
    fields.push_back({name, offset, static_cast<FieldType>(input.next(1)), size_from(input)});
  }
  PointBuffer buffer;
  buffer.fields = fields;
  buffer.point_step = size_from(input);
  buffer.width = size_from(input);
  buffer.height = size_from(input);
  buffer.row_step = size_from(input);
  buffer.big_endian = input.next(1) % 2 == 1;
  buffer.data = std::as_bytes(input.take(size));

  cloud::Cloud cloud;
  const auto read = unpack(buffer, cloud);
  if (!read) {
    fuzz::require(to_string(read.error().fault) != "unknown", "a refusal has a name");
    fuzz::require(!read.error().message.empty(), "a refusal says what was found");
    return 0;
  }
  fuzz::require(cloud.points.size() == buffer.width * buffer.height, "as many points as promised");
  fuzz::require(cloud.laser.empty() || cloud.laser.size() == cloud.points.size());
  auto segmenter = Segmenter::make({});
  const auto labels = segmenter->label(buffer);
  if (labels) fuzz::require(labels->size() == cloud.points.size(), "a label for each point");
  return 0;
}
