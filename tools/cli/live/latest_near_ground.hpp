// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>

#include "pipeline/near_ground.hpp"
#include "rt/fixed_memory.hpp"
#include "rt/latest_value.hpp"
#include "rt/nonblocking.hpp"

namespace terracut::cli {

/// Carries the near ground of a turn now and then from the segmenting thread to the one that checks
/// the mount. Each side has one thread; neither waits for the other.
class LatestNearGround {
 public:
  explicit LatestNearGround(rt::FixedMemory& memory)
      : slots_(memory.take<pipeline::NearGround>("near ground", rt::LatestSlot::kSlots)) {}

  /// Segmenting thread: copies the near ground of this turn.
  void take(const pipeline::RangeImage& image) noexcept TERRACUT_NONBLOCKING {
    pipeline::take_near_ground(image, slots_[slot_.writer_slot()]);
    (void)slot_.publish();
  }
  /// Checking thread: the newest, where it has not been returned yet; else null. Valid until the
  /// next call.
  [[nodiscard]] const pipeline::NearGround* newest() noexcept {
    return slot_.take_if_new() ? &slots_[slot_.reader_slot()] : nullptr;
  }

 private:
  std::span<pipeline::NearGround> slots_;
  rt::LatestSlot slot_;
};

}  // namespace terracut::cli
