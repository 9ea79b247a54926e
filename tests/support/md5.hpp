// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

namespace terracut::test {

/// The MD5 of some bytes (RFC 1321) in lower-case hexadecimal, for comparing with published
/// digests.
inline std::string md5_hex(std::string bytes) {
  constexpr std::array<std::array<int, 4>, 4> kTurns{
      {{7, 12, 17, 22}, {5, 9, 14, 20}, {4, 11, 16, 23}, {6, 10, 15, 21}}};
  std::array<std::uint32_t, 4> sum{0x67452301, 0xEFCDAB89, 0x98BADCFE, 0x10325476};
  const std::uint64_t bits = std::uint64_t{bytes.size()} * 8;
  bytes += static_cast<char>(0x80);
  while (bytes.size() % 64 != 56) bytes += '\0';
  for (int byte = 0; byte < 8; ++byte) bytes += static_cast<char>(bits >> (8 * byte) & 0xFF);
  for (std::size_t block = 0; block < bytes.size(); block += 64) {
    std::array<std::uint32_t, 16> words{};
    for (std::size_t i = 0; i < 64; ++i) {
      words[i / 4] |= std::uint32_t{static_cast<std::uint8_t>(bytes[block + i])} << (8 * (i % 4));
    }
    auto [a, b, c, d] = sum;
    for (std::uint32_t i = 0; i < 64; ++i) {
      const std::uint32_t round = i / 16;
      const std::uint32_t mixed = round == 0   ? (b & c) | (~b & d)
                                  : round == 1 ? (d & b) | (~d & c)
                                  : round == 2 ? b ^ c ^ d
                                               : c ^ (b | ~d);
      const std::uint32_t word = round == 0   ? i
                                 : round == 1 ? (5 * i + 1) % 16
                                 : round == 2 ? (3 * i + 5) % 16
                                              : 7 * i % 16;
      const auto sine =
          static_cast<std::uint32_t>(std::floor(std::abs(std::sin(i + 1.0)) * 0x1p32));
      const std::uint32_t added = a + mixed + sine + words[word];
      a = d;
      d = c;
      c = b;
      b += std::rotl(added, kTurns[round][i % 4]);
    }
    sum[0] += a;
    sum[1] += b;
    sum[2] += c;
    sum[3] += d;
  }
  std::string hex;
  for (const std::uint32_t word : sum) {
    for (int byte = 0; byte < 4; ++byte) {
      constexpr const char* kDigits = "0123456789abcdef";
      hex += kDigits[word >> (8 * byte + 4) & 0xF];
      hex += kDigits[word >> (8 * byte) & 0xF];
    }
  }
  return hex;
}

}  // namespace terracut::test
