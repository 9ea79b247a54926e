// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/fixed_memory.hpp"

#include <algorithm>
#include <cstring>

namespace terracut::rt {

void* FixedMemory::take_bytes(std::string_view part, std::size_t bytes) {
  const std::size_t rounded = (bytes + kAlignment - 1) / kAlignment * kAlignment;
  auto* block = static_cast<std::byte*>(::operator new(rounded, std::align_val_t{kAlignment}));
  blocks_.emplace_back(block);
  std::memset(block, 0, rounded);  // also touches every page, so that none is missing later
  auto entry = std::find_if(parts_.begin(), parts_.end(),
                            [&](const Part& known) { return known.name == part; });
  if (entry == parts_.end()) entry = parts_.insert(parts_.end(), Part{std::string(part), 0});
  entry->bytes += rounded;
  return block;
}

std::size_t FixedMemory::total_bytes() const noexcept {
  std::size_t total = 0;
  for (const Part& part : parts_) total += part.bytes;
  return total;
}

}  // namespace terracut::rt
