// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Any bytes at all, and any bytes behind a good header, as text, binary and compressed data. The
// outcome is an error that names the file in printable words, or as many values of every field as
// points.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "tools/research/datasets/pcd_cloud.hpp"

namespace {

void check(bool holds) {
  if (!holds) std::abort();
}

void check_content(const std::string& content) {
  const auto cloud = terracut::datasets::PcdCloud::parse(content, "fuzz");
  if (!cloud) {
    const std::string& message = cloud.error().message;
    check(message.starts_with("fuzz: "));
    check(std::all_of(message.begin(), message.end(), [](char c) { return c >= ' ' && c <= '~'; }));
    return;
  }
  check(cloud->points() > 0);
  for (const std::string& name : cloud->fields()) {
    const auto values = cloud->field(name);
    check(values.has_value() && values->size() == cloud->points());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(data, data + size);
  check_content(bytes);
  const std::string header =
      "FIELDS x h laser label\nSIZE 4 2 1 8\nTYPE F I U I\nCOUNT 1 2 1 1\nPOINTS 2\nDATA ";
  check_content(header + "ascii\n" + bytes);
  check_content(header + "binary\n" + bytes);
  // Two points of 17 bytes, and sizes that let the bytes be unpacked.
  const std::string sizes{static_cast<char>(size), static_cast<char>(size >> 8), 0, 0, 34, 0, 0, 0};
  check_content(header + "binary_compressed\n" + sizes + bytes);
  return 0;
}
