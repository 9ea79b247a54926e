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

enum class Holds : std::uint8_t { kNothing, kPacked, kRecording };

struct KnownStart {
  std::string_view bytes;
  std::string_view name;
  Holds holds = Holds::kNothing;
};

constexpr auto kPcd = "a PCD point cloud, not packets; `terracut segment` labels clouds"sv,
               kPly = "a PLY point cloud, not packets; `terracut segment` labels clouds"sv;

constexpr std::array kKnownStarts{
    KnownStart{"\x1f\x8b"sv, "gzip; unpack it first (gunzip)", Holds::kPacked},
    KnownStart{"\x28\xb5\x2f\xfd"sv, "zstd; unpack it first (unzstd)", Holds::kPacked},
    KnownStart{"\xfd\x37zXZ"sv, "xz; unpack it first (unxz)", Holds::kPacked},
    KnownStart{"BZh"sv, "bzip2; unpack it first (bunzip2)", Holds::kPacked},
    KnownStart{"PK\x03\x04"sv, "a zip archive; unpack it first", Holds::kPacked},
    KnownStart{"#ROSBAG"sv, "a ROS bag of ROS 1; convert it to ROS 2 (rosbags-convert)", Holds::kRecording},
    KnownStart{"snoop\0"sv, "a snoop capture; convert it (editcap -F pcap)", Holds::kRecording},
    KnownStart{"# .PCD"sv, kPcd},
    KnownStart{"VERSION "sv, kPcd},
    KnownStart{"ply\n"sv, kPly},
    KnownStart{"ply\r"sv, kPly},
    KnownStart{"LASF"sv, "a LAS point cloud, not packets", Holds::kRecording},
    KnownStart{"<?xml"sv, "XML (a calibration?), not packets"},
    KnownStart{"\x89PNG"sv, "a PNG picture"},
    KnownStart{"\x7f"
               "ELF"sv,
               "a program"},
};

bool begins_with(std::span<const std::uint8_t> bytes, std::string_view start) {
  return bytes.size() >= start.size() &&
         std::equal(start.begin(), start.end(), bytes.begin(),
                    [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

const KnownStart* known_start(std::span<const std::uint8_t> bytes) {
  const auto known = std::ranges::find_if(
      kKnownStarts, [&](const KnownStart& start) { return begins_with(bytes, start.bytes); });
  return known == kKnownStarts.end() ? nullptr : &*known;
}

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
  if (const KnownStart* const known = known_start(first_bytes)) {
    return fmt::format("{}: {}", text, known->name);
  }
  return text + (is_text(first_bytes) ? ": text" : ": of unknown kind");
}

std::optional<ForeignKind> foreign_kind(std::span<const std::uint8_t> first_bytes) {
  const KnownStart* const known = known_start(first_bytes);
  if (known == nullptr || known->holds == Holds::kNothing) return std::nullopt;
  return ForeignKind{known->name, known->holds == Holds::kPacked};
}

bool begins_as_capture(std::span<const std::uint8_t> first_bytes) {
  // The magic numbers of draft-ietf-opsawg-pcap and -pcapng. The third belongs to an older kind of
  // pcap with longer records.
  constexpr std::array kPcapStarts{"\xa1\xb2\xc3\xd4"sv, "\xd4\xc3\xb2\xa1"sv,
                                   "\xa1\xb2\xcd\x34"sv, "\x34\xcd\xb2\xa1"sv,
                                   "\xa1\xb2\x3c\x4d"sv, "\x4d\x3c\xb2\xa1"sv};
  constexpr std::array kByteOrders{"\x1a\x2b\x3c\x4d"sv, "\x4d\x3c\x2b\x1a"sv};
  constexpr std::size_t kByteOrderAt = 8;
  const auto is_start_of = [&](std::span<const std::uint8_t> bytes) {
    return [bytes](std::string_view start) { return begins_with(bytes, start); };
  };
  if (std::ranges::any_of(kPcapStarts, is_start_of(first_bytes))) return true;
  return begins_with(first_bytes, "\x0a\x0d\x0d\x0a"sv) && first_bytes.size() > kByteOrderAt &&
         std::ranges::any_of(kByteOrders, is_start_of(first_bytes.subspan(kByteOrderAt)));
}

std::string_view capture_stem(std::string_view file_name) {
  const std::size_t last = file_name.find_last_not_of("0123456789.-_");
  const std::string_view name = file_name.substr(0, last == std::string_view::npos ? 0 : last + 1);
  for (const std::string_view ending : {".pcapng"sv, ".pcap"sv, ".cap"sv}) {
    if (name.size() <= ending.size()) continue;
    const std::size_t stem = name.size() - ending.size();
    const auto is_same = [](char a, char b) { return a == b || (b >= 'a' && a == b - 'a' + 'A'); };
    if (std::ranges::equal(name.substr(stem), ending, is_same)) return name.substr(0, stem);
  }
  return {};
}

}  // namespace terracut::capture
