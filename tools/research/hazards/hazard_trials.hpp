// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ground_kind.hpp"
#include "hazard_choice.hpp"
#include "scan_writer.hpp"
#include "tools/research/datasets/class_table.hpp"
#include "tools/research/eval/labelled_by_all.hpp"
#include "tools/research/eval/method_choice.hpp"
#include "trial_counts.hpp"

namespace terracut::hazards {

/// Identifies the trials that are counted together.
struct TrialKey {
  std::size_t kind = 0;  ///< Index in HazardChoice::kinds.
  GroundKind ground = GroundKind::kRoad;
  std::size_t bin = 0;  ///< Index in kRangeBins.
  friend auto operator<=>(const TrialKey&, const TrialKey&) = default;
};

/// The trials of one method.
struct MethodTrials {
  std::map<TrialKey, TrialCounts> hazards;
  /// The keys are the index in HazardChoice::disturbances, then the sequence.
  std::map<std::size_t, std::map<std::string, Elsewhere>> disturbances;
};

/// Puts hazards and disturbances into labelled frames, one at a time, and counts how methods label
/// them. Random numbers depend only on the seed, on the names of sequence and frame, and on the
/// word of the hazard, so the order of frames does not matter. For any thread.
class HazardTrials {
 public:
  /// `methods`, `classes` and `writer` must outlive this object. `writer`, which may be null, gets
  /// every frame without and with each hazard and disturbance.
  HazardTrials(std::span<const eval::MethodChoice> methods, const datasets::ClassTable& classes,
               HazardChoice choice, ScanWriter* writer = nullptr)
      : methods_(methods),
        classes_(classes),
        choice_(std::move(choice)),
        writer_(writer),
        trials_(methods.size()) {}

  /// Makes all trials on a frame.
  void look(const eval::LabelledByAll& frame);

  [[nodiscard]] const HazardChoice& choice() const noexcept { return choice_; }
  /// Returns the trials by method. Must not be called during look().
  [[nodiscard]] const std::vector<MethodTrials>& trials() const noexcept { return trials_; }
  /// True if no trial was possible in any frame. Must not be called during look().
  [[nodiscard]] bool is_empty() const;
  /// Returns the number of frames without any labelled ground 5 to 60 m away.
  [[nodiscard]] std::size_t frames_without_ground() const noexcept {
    return frames_without_ground_;
  }

 private:
  std::span<const eval::MethodChoice> methods_;
  const datasets::ClassTable& classes_;
  HazardChoice choice_;
  ScanWriter* writer_;
  std::mutex mutex_;  ///< Guards the following members.
  std::vector<MethodTrials> trials_;
  std::size_t frames_without_ground_ = 0;
};

}  // namespace terracut::hazards
