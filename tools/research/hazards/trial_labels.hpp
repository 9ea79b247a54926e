// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/frame/label.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "labelled_frame.hpp"
#include "moved_return.hpp"
#include "rt/memory/fixed_memory.hpp"
#include "tools/research/eval/method_bench.hpp"
#include "tools/research/eval/method_choice.hpp"

namespace terracut::hazards {

/// Labels one frame repeatedly, each time with other returns moved, and independently of the times
/// before.
class TrialLabels {
 public:
  /// The first two arguments must outlive this object.
  TrialLabels(std::span<const eval::MethodChoice> methods, const LabelledFrame& frame,
              const mount::RingProfile& profile);

  /// Labels the frame with every method.
  void label(const MovedReturns& moved);

  /// Returns the frame as it was labelled, with returns moved; valid, as what the next two
  /// functions return, until the next label().
  [[nodiscard]] const frame::RangeImage& image() const { return image_; }
  /// Returns the labels of methods[index] by return index of image().
  [[nodiscard]] std::span<const frame::Label> of_image(std::size_t index) const {
    return bench_.labels(index);
  }
  [[nodiscard]] const stage::CellPlanes& planes(std::size_t index) const {
    return bench_.planes(index);
  }

  /// Returns the labels of methods[index] by return index of the frame, valid until the next
  /// label(); kNone for removed returns.
  [[nodiscard]] std::span<const frame::Label> of(std::size_t index) const { return labels_[index]; }

 private:
  void place(const MovedReturns& moved);

  const LabelledFrame& frame_;
  memory::FixedMemory memory_;
  frame::RangeImage image_;
  eval::MethodBench bench_;
  std::vector<std::uint32_t> placed_;              ///< Index in the frame of each return of image_.
  std::vector<std::vector<frame::Label>> labels_;  ///< Indexed by method.
};

}  // namespace terracut::hazards
