// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>

#include "firmware_io/velodyne/packet_layout.hpp"

namespace terracut::fuzz {

/// How many returns a data packet of Velodyne's carries: the VLS-128's in dual return, which begins
/// with two blocks of one id side by side, has nothing in its last four blocks.
inline std::uint64_t velodyne_returns_in(std::span<const std::uint8_t> payload) {
  const auto* packet = hdl64e::packet_in(payload);
  if (packet == nullptr) return 0;
  const bool has_empty_blocks = packet->status_type == velodyne::kDual &&
                                packet->blocks[2].id.value() == hdl64e::kLowerBlockId;
  std::uint64_t returns = 0;
  for (std::size_t block = 0; block < (has_empty_blocks ? 8U : 12U); ++block) {
    for (const auto& one : packet->blocks[block].returns) returns += one.distance.value() != 0;
  }
  return returns;
}

}  // namespace terracut::fuzz
