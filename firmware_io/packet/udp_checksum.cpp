// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/packet/udp_checksum.hpp"

#include <cstddef>

namespace terracut::packet {
namespace {

/// Sums big-endian 16-bit words; an odd last byte counts as if a 0 followed. The sum of 64 kB fits
/// 64 bits.
std::uint64_t sum_words(std::span<const std::uint8_t> bytes) noexcept {
  std::uint64_t sum = 0;
  std::size_t i = 0;
  for (; i + 1 < bytes.size(); i += 2) {
    sum += static_cast<std::uint64_t>(bytes[i] << 8 | bytes[i + 1]);
  }
  if (i < bytes.size()) {
    sum += std::uint64_t{bytes[i]} << 8;
  }
  return sum;
}

std::uint16_t folded_complement(std::uint64_t sum) noexcept {
  while (sum > 0xFFFF) {
    sum = (sum & 0xFFFF) + (sum >> 16);
  }
  return static_cast<std::uint16_t>(~sum & 0xFFFF);
}

}  // namespace

std::uint16_t internet_checksum(std::span<const std::uint8_t> bytes) noexcept {
  return folded_complement(sum_words(bytes));
}

std::uint16_t udp_checksum(const Datagram& datagram) noexcept {
  constexpr std::uint64_t kProtocolUdp = 17;
  const std::uint64_t udp_bytes = 8 + datagram.payload.size();
  const std::uint64_t addresses =
      std::uint64_t{datagram.source_address >> 16} + (datagram.source_address & 0xFFFF) +
      (datagram.destination_address >> 16) + (datagram.destination_address & 0xFFFF);
  const std::uint64_t pseudo_header = addresses + kProtocolUdp + udp_bytes;
  const std::uint64_t header =
      std::uint64_t{datagram.source_port} + datagram.destination_port + udp_bytes;
  const std::uint16_t sum = folded_complement(pseudo_header + header + sum_words(datagram.payload));
  return sum == 0 ? std::uint16_t{0xFFFF} : sum;
}

}  // namespace terracut::packet
