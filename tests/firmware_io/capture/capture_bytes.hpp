// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "tests/support/scratch_folder.hpp"

/// Frames and capture files put together byte by byte, apart from the code under test.
namespace terracut::test {

using Bytes = std::vector<std::uint8_t>;

inline Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

inline Bytes big16(unsigned value) {
  return {static_cast<std::uint8_t>(value >> 8), static_cast<std::uint8_t>(value)};
}
inline Bytes little32(std::uint32_t value) {
  return {static_cast<std::uint8_t>(value), static_cast<std::uint8_t>(value >> 8),
          static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 24)};
}

inline Bytes counting(std::size_t size) {
  Bytes bytes(size);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

struct IpFrame {
  Bytes payload = counting(10);
  std::uint16_t source_port = 443;
  std::uint16_t destination_port = 2368;
  Bytes source = {192, 168, 3, 43};
  std::uint8_t protocol = 17;
  std::uint16_t fragment_field = 0;
  std::size_t option_bytes = 0;    ///< Multiple of four.
  int total_length_error = 0;      ///< Added to the IP total length.
  int udp_length_error = 0;        ///< Added to the UDP length.
  bool zero_total_length = false;  ///< As captures made before segmentation offload have it.
  std::uint8_t version = 4;

  /// IPv4 header, UDP header and payload; checksums 0.
  [[nodiscard]] Bytes bytes() const {
    const std::size_t header = 20 + option_bytes;
    const int udp = static_cast<int>(8 + payload.size());
    const int total = zero_total_length ? 0 : static_cast<int>(header) + udp + total_length_error;
    return joined({{static_cast<std::uint8_t>(version << 4 | static_cast<int>(header / 4)), 0},
                   big16(static_cast<unsigned>(total)),
                   {0, 0},
                   big16(fragment_field),
                   {64, protocol, 0, 0},
                   source,
                   {192, 168, 3, 255},
                   Bytes(option_bytes, 1),
                   big16(source_port),
                   big16(destination_port),
                   big16(static_cast<unsigned>(udp + udp_length_error)),
                   {0, 0},
                   payload});
  }
};

inline Bytes ethernet(const Bytes& inner, unsigned ether_type = 0x0800,
                      std::initializer_list<unsigned> vlan_tags = {}) {
  Bytes frame(12, 0x02);
  for (const unsigned tag : vlan_tags) frame = joined({frame, big16(tag), {0x00, 0x07}});
  return joined({frame, big16(ether_type), inner});
}

/// A classic capture with microsecond stamps, little endian; every record one second after the
/// other.
class CaptureFile {
 public:
  explicit CaptureFile(std::uint32_t link_type = 1, std::uint32_t magic = 0xA1B2C3D4) {
    bytes_ = joined({little32(magic),
                     {2, 0, 4, 0},
                     little32(0),
                     little32(0),
                     little32(65535),
                     little32(link_type)});
  }
  CaptureFile& add(const Bytes& frame) { return add(frame, frame.size()); }
  /// `captured` bytes kept of the frame.
  CaptureFile& add(const Bytes& frame, std::size_t captured) {
    bytes_ = joined({bytes_, little32(++seconds_), little32(250),
                     little32(static_cast<std::uint32_t>(captured)),
                     little32(static_cast<std::uint32_t>(frame.size())),
                     Bytes(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(captured))});
    return *this;
  }
  [[nodiscard]] const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
  std::uint32_t seconds_ = 1'000;
};

inline void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
}

inline Bytes read_file(const std::filesystem::path& path) {
  const std::string text = content_of(path);
  return {text.begin(), text.end()};
}

}  // namespace terracut::test
