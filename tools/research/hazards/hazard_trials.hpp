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

/// Which trials are counted together.
struct TrialKey {
  std::size_t kind = 0;  ///< Index in HazardChoice::kinds.
  GroundKind ground = GroundKind::kRoad;
  std::size_t bin = 0;  ///< Index in kRangeBins.
  friend auto operator<=>(const TrialKey&, const TrialKey&) = default;
};

/// The trials of one method.
struct MethodTrials {
  std::map<TrialKey, TrialCounts> hazards;
  /// By disturbance, its index in HazardChoice, and sequence.
  std::map<std::size_t, std::map<std::string, Elsewhere>> disturbances;
};

/// Puts hazards, one at a time, and disturbances into labelled frames, and counts what methods make
/// of them. What is drawn depends only on the seed, the names of sequence and frame, and the word
/// of what is put there; the result does not depend on the order of frames. From any thread.
class HazardTrials {
 public:
  /// `methods`, `classes` and `writer` must outlive this object. Every frame is also written, with
  /// each thing that was put into it and without, if `writer` is not null.
  HazardTrials(std::span<const eval::MethodChoice> methods, const datasets::ClassTable& classes,
               HazardChoice choice, ScanWriter* writer = nullptr)
      : methods_(methods),
        classes_(classes),
        choice_(std::move(choice)),
        writer_(writer),
        trials_(methods.size()) {}

  /// Tries everything on a frame.
  void look(const eval::LabelledByAll& frame);

  [[nodiscard]] const HazardChoice& choice() const noexcept { return choice_; }
  /// Returns the trials by method. Only when no frame is looked at.
  [[nodiscard]] const std::vector<MethodTrials>& trials() const noexcept { return trials_; }
  /// True if there was no place for anything in any frame. Only when no frame is looked at.
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
