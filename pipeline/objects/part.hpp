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

/// True if one of the cells [cell, cell + 8) is of that part; a row is padded to sixteen cells.
[[nodiscard]] inline bool is_among_eight(Part part, std::span<const Part> parts,
                                         std::uint32_t cell) noexcept {
  std::uint64_t eight;
  std::memcpy(&eight, &parts[cell], sizeof(eight));
  return (eight & (0x0101010101010101U * static_cast<std::uint8_t>(part))) != 0;
}

}  // namespace terracut::objects
