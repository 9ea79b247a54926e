// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string_view>
#include <vector>

#include "instances.hpp"
#include "tools/research/eval/labelled_by_all.hpp"

namespace terracut::object_measures {

/// True for the SemanticKITTI sequences on which the parameters of objects were chosen; everything
/// else is for judging.
[[nodiscard]] constexpr bool is_tuned_on(std::string_view sequence) noexcept {
  return sequence == "00" || sequence == "01" || sequence == "06";
}

/// A number that differs from frame to frame.
struct Spread {
  double sum = 0, sum_of_squares = 0;

  void add(double value) noexcept;
  [[nodiscard]] double mean(std::uint64_t of) const noexcept;
  [[nodiscard]] double deviation(std::uint64_t of) const noexcept;
};

/// The objects of some frames.
struct ObjectCounts {
  std::uint64_t frames = 0;
  Spread objects, over_segmentation, under_segmentation;  ///< Of a frame.
  Spread milliseconds;  ///< Processor time to find a frame's objects, the shortest of three.
  InstancesByKind instances;
};

/// The objects of one method on sequences that the parameters were chosen on, and on others.
struct SplitCounts {
  ObjectCounts tuned, unseen;
};

/// Finds the objects in frames that methods have labelled, and compares them with the truth. For
/// any thread.
class ObjectTrials {
 public:
  explicit ObjectTrials(std::size_t methods) : counts_(methods) {}

  void look(const eval::LabelledByAll& frame);

  /// Must not be called during look().
  [[nodiscard]] const SplitCounts& counts(std::size_t method) const { return counts_[method]; }

 private:
  std::mutex mutex_;  ///< Guards the following member.
  std::vector<SplitCounts> counts_;
};

}  // namespace terracut::object_measures
