// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/capture/file_kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace terracut::capture {
namespace {

using namespace std::string_view_literals;

struct KnownStart {
  std::string_view bytes;
  std::string_view name;
};

constexpr std::array kKnownStarts{
    KnownStart{"\x1f\x8b"sv, "gzip; unpack it first (gunzip)"},
    KnownStart{"\x28\xb5\x2f\xfd"sv, "zstd; unpack it first (unzstd)"},
    KnownStart{"\xfd\x37zXZ"sv, "xz; unpack it first (unxz)"},
    KnownStart{"BZh"sv, "bzip2; unpack it first (bunzip2)"},
    KnownStart{"PK\x03\x04"sv, "a zip archive; unpack it first"},
    KnownStart{"#ROSBAG"sv, "a ROS bag; write its packets to a pcap first"},
    KnownStart{"\x89MCAP"sv, "MCAP; write its packets to a pcap first"},
    KnownStart{"SQLite format 3"sv,
               "an SQLite file (a ROS 2 bag?); write its packets to a pcap first"},
    KnownStart{"snoop\0"sv, "a snoop capture; convert it (editcap -F pcap)"},
    KnownStart{"# .PCD"sv, "a PCD point cloud, not packets"},
    KnownStart{"ply\n"sv, "a PLY point cloud, not packets"},
    KnownStart{"LASF"sv, "a LAS point cloud, not packets"},
    KnownStart{"<?xml"sv, "XML (a calibration?), not packets"},
    KnownStart{"\x89PNG"sv, "a PNG picture"},
    KnownStart{"\x7f"
               "ELF"sv,
               "a program"},
};

bool is_text(std::span<const std::uint8_t> bytes) {
  return std::all_of(bytes.begin(), bytes.end(), [](std::uint8_t byte) {
    return (byte >= 0x20 && byte < 0x7F) || byte == '\n' || byte == '\r' || byte == '\t';
  });
}

}  // namespace

std::string describe_first_bytes(std::span<const std::uint8_t> first_bytes) {
  std::string text;
  for (const std::uint8_t byte : first_bytes.first(std::min<std::size_t>(8, first_bytes.size()))) {
    text += fmt::format("{}{:02x}", text.empty() ? "" : " ", byte);
  }
  for (const KnownStart& known : kKnownStarts) {
    if (first_bytes.size() >= known.bytes.size() &&
        std::equal(known.bytes.begin(), known.bytes.end(), first_bytes.begin(),
                   [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; })) {
      return fmt::format("{}: {}", text, known.name);
    }
  }
  return text + (is_text(first_bytes) ? ": text" : ": of unknown kind");
}

}  // namespace terracut::capture
