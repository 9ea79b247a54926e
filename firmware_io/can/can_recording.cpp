// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/can/can_recording.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>

#include "rt/files/plain_file.hpp"

namespace terracut::can {
namespace {

/// True if the file begins like a pcap or pcapng capture. A candump log is text instead.
bool begins_like_capture(const std::filesystem::path& path) {
  using Magic = std::array<std::uint8_t, 4>;
  constexpr std::array<Magic, 5> kMagics{
      Magic{0xD4, 0xC3, 0xB2, 0xA1}, Magic{0xA1, 0xB2, 0xC3, 0xD4}, Magic{0x4D, 0x3C, 0xB2, 0xA1},
      Magic{0xA1, 0xB2, 0x3C, 0x4D}, Magic{0x0A, 0x0D, 0x0D, 0x0A}};
  Magic first{};
  std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(first.data()), first.size());
  return std::ranges::find(kMagics, first) != kMagics.end();
}

}  // namespace

Expected<CanRecording> CanRecording::open(const std::filesystem::path& path,
                                          std::string interface) {
  const auto made = [](auto source) -> Expected<CanRecording> {
    if (!source) return tl::unexpected(source.error());
    return CanRecording(*std::move(source));
  };
  if (const Status twice = files::check_readable_twice(path); !twice) {
    return tl::unexpected(twice.error());
  }
  if (begins_like_capture(path)) return made(CanPcapSource::open(path));
  return made(CandumpSource::open(path, std::move(interface)));
}

}  // namespace terracut::can
