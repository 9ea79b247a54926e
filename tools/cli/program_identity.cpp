// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "program_identity.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>

namespace terracut::cli {

std::string program_identity() {
  std::ifstream file("/proc/self/exe", std::ios::binary);
  if (!file) return "unknown";
  // FNV-1a, 64 bits: no safeguard against malice, only against mistaking one's own builds.
  std::uint64_t hash = 0xCBF29CE484222325;
  std::array<char, 1 << 16> block{};
  while (file.read(block.data(), block.size()) || file.gcount() > 0) {
    for (std::streamsize i = 0; i < file.gcount(); ++i) {
      hash =
          (hash ^ static_cast<unsigned char>(block[static_cast<std::size_t>(i)])) * 0x100000001B3;
    }
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace terracut::cli
