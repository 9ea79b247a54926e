// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/memory/fixed_memory.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace terracut::memory {

Expected<std::vector<threads::Grant>> FixedMemory::reserve(std::size_t bytes,
                                                           const RegionRequest& request) {
  if (!parts_.empty() || !region_.bytes().empty()) {
    return fail(ErrorCode::kInvalidArgument,
                "memory must be reserved once, before anything is taken from it");
  }
  auto region = MemoryRegion::map(bytes, request);
  if (!region) return tl::unexpected(region.error());
  region_ = std::move(*region);
  return region_.grants();
}

void* FixedMemory::take_bytes(std::string_view part, std::size_t bytes) {
  const std::size_t rounded = (bytes + kAlignment - 1) / kAlignment * kAlignment;
  std::byte* block = nullptr;
  if (rounded <= region_.bytes().size() - used_) {
    block = region_.bytes().data() + used_;  // fresh pages of the region are zero
    used_ += rounded;
  } else {
    block = from_heap(rounded);
    if (!region_.bytes().empty() && first_too_large_.empty()) first_too_large_ = part;
  }
  auto entry = std::find_if(parts_.begin(), parts_.end(),
                            [&](const Part& known) { return known.name == part; });
  if (entry == parts_.end()) entry = parts_.insert(parts_.end(), Part{std::string(part), 0});
  entry->bytes += rounded;
  return block;
}

std::byte* FixedMemory::from_heap(std::size_t bytes) {
  auto* block = static_cast<std::byte*>(::operator new (bytes, std::align_val_t{kAlignment}));
  blocks_.emplace_back(block);
  std::memset(block, 0, bytes);  // also touches every page, so that none is missing later
  return block;
}

std::size_t FixedMemory::total_bytes() const noexcept {
  std::size_t total = 0;
  for (const Part& part : parts_) total += part.bytes;
  return total;
}

Status FixedMemory::within_plan() const {
  if (first_too_large_.empty()) return {};
  return fail(ErrorCode::kCapacityExceeded,
              "the memory planned at start does not hold all: " +
                  std::to_string(region_.bytes().size()) + " bytes were reserved, " +
                  std::to_string(total_bytes()) + " were taken, and '" + first_too_large_ +
                  "' was the first part that did not fit. The plan was made for other settings");
}

}  // namespace terracut::memory
