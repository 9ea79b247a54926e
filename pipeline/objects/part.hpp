// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <cstring>
#include <span>

namespace terracut::objects {

/// What an obstacle cell is part of.
enum class Part : std::uint8_t {
  kNone = 0,  ///< No obstacle.
  kBody = 1,  ///< Something that stands out of the ground.
  kFoot = 2,  ///< What is low: growth, kerbs, rough ground, and the lowest returns of bodies.
};

inline constexpr std::uint32_t kEightCells = 8;

/// Returns a bit for each of the cells [cell, cell + 8), the lowest for the first: whether it is of
/// that part. Rows are padded to sixteen cells.
[[nodiscard]] inline std::uint32_t among_eight(Part part, std::span<const Part> parts,
                                               std::uint32_t cell) noexcept {
  std::uint64_t eight;
  std::memcpy(&eight, &parts[cell], sizeof(eight));
  constexpr std::uint64_t kLowestBits = 0x0101010101010101U;
  const std::uint64_t is_part = (eight >> static_cast<int>(part == Part::kFoot)) & kLowestBits;
  return static_cast<std::uint32_t>((is_part * 0x0102040810204080U) >> 56);  // byte i to bit i
}

}  // namespace terracut::objects
