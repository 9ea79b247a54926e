// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/min_cut/near_unknown.hpp"

#include <array>
#include <cstring>

namespace terracut::min_cut {

NearUnknown::NearUnknown(frame::ImageShape shape, memory::FixedMemory& memory)
    : columns_(shape.columns),
      rows_(static_cast<std::size_t>(shape.rows)),
      groups_(static_cast<std::size_t>(shape.stride()) / kColumnsAGroup),
      unknown_(memory.take<std::uint8_t>("seeds", rows_ * groups_)),
      near_(memory.take<std::uint8_t>("seeds", unknown_.size())) {}

void NearUnknown::find(std::span<const Seed> seeds) noexcept {
  constexpr std::uint64_t kAnyUnknown =
      0x0101'0101'0101'0101 * static_cast<std::uint64_t>(Seed::kUnknown);
  for (std::size_t group = 0; group < unknown_.size(); ++group) {
    std::array<std::uint64_t, kColumnsAGroup / sizeof(std::uint64_t)> words;
    std::memcpy(words.data(), &seeds[group * kColumnsAGroup], sizeof(words));
    unknown_[group] = ((words[0] | words[1]) & kAnyUnknown) != 0 ? 1 : 0;
  }
  for (std::size_t row = 0; row < rows_; ++row) {
    const std::size_t below = row == 0 ? row : row - 1;
    const std::size_t above = row + 1 == rows_ ? row : row + 1;
    for (std::size_t group = 0; group < groups_; ++group) {
      near_[row * groups_ + group] = static_cast<std::uint8_t>(unknown_[row * groups_ + group] |
                                                               unknown_[below * groups_ + group] |
                                                               unknown_[above * groups_ + group]);
    }
  }
}

}  // namespace terracut::min_cut
