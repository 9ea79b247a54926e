// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Any bytes at all, and any bytes behind a good header, as text, binary and compressed data, as PCD
// and as PLY. The outcome is an error that names the file in printable words, or as many values of
// every field as points.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "firmware_io/cloud/pcd_file.hpp"
#include "firmware_io/cloud/ply_file.hpp"

namespace {

void check(bool holds) {
  if (!holds) std::abort();
}

void check_table(const terracut::Expected<terracut::cloud::FieldTable>& cloud) {
  if (!cloud) {
    const std::string& message = cloud.error().message;
    check(message.starts_with("fuzz: "));
    check(std::all_of(message.begin(), message.end(), [](char c) { return c >= ' ' && c <= '~'; }));
    return;
  }
  check(cloud->names.size() == cloud->values.size());
  for (const auto& values : cloud->values) check(values.size() == cloud->points);
}

void check_content(const std::string& content) {
  check_table(terracut::cloud::parse_pcd(content, "fuzz"));
}

void check_ply(const std::string& content) {
  check_table(terracut::cloud::parse_ply(content, "fuzz"));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(data, data + size);
  check_content(bytes);
  const std::string header =
      "FIELDS x h laser label\nSIZE 4 2 1 8\nTYPE F I U I\nCOUNT 1 2 1 1\nPOINTS 2\nDATA ";
  check_content(header + "ascii\n" + bytes);
  check_content(
      "COLUMNS x _ y\nSIZE 4 1 8\nTYPE f u f\nCOUNT 1 0 1\nWIDTH 2\nHEIGHT 1\nDATA ascii\n" +
      bytes);
  check_content(header + "binary\n" + bytes);
  // Two points of 17 bytes, and sizes that let the bytes be unpacked.
  const std::string sizes{static_cast<char>(size), static_cast<char>(size >> 8), 0, 0, 34, 0, 0, 0};
  check_content(header + "binary_compressed\n" + sizes + bytes);

  check_ply(bytes);
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    check_ply(std::string("ply\nformat ") + format +
              " 1.0\nelement vertex 2\nproperty float x\nproperty uchar ring\nproperty double t\n"
              "end_header\n" +
              bytes);
  }
  check_ply("ply\nformat ascii 1.0\n" + bytes);
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    check_ply(std::string("ply\nformat ") + format +
              " 1.0\nelement vertex 2\nproperty list char int l\nproperty short x\nend_header\n" +
              bytes);
  }
  return 0;
}
