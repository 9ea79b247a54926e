// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "paired_test.hpp"
#include "rt/error.hpp"

namespace terracut::evaluation {

/// How one measure changed from one evaluation to another.
struct MeasureChange {
  std::string measure;  ///< "iou_g", "recall_o", "iou_road", "ms"
  bool more_is_better = true;
  double before = 0, after = 0;  ///< Means over the frames both have.
  PairedTest frames;             ///< signed_rank_test() over frames, after - before.
  /// sign_flip_test() over the means of sequences: frames that follow each other look alike, so
  /// that the test over frames finds too much. None below 2 or above 20 sequences.
  std::optional<PairedTest> sequences;

  [[nodiscard]] bool worse(double significance) const noexcept {
    const double gain = more_is_better ? after - before : before - after;
    return gain < 0 && frames.p < significance;
  }
};

struct Comparison {
  std::string before, after;  ///< What was compared: "paper of A.json".
  std::size_t frames = 0;     ///< In both.
  std::size_t only_before = 0, only_after = 0;
  std::vector<MeasureChange> changes;
};

/// Compares `method_before` of one report (evaluation_json()) with `method_after` of another, over
/// the frames both have. kMalformed: no report, or a method it does not have; kInvalidArgument: no
/// frame in common.
[[nodiscard]] Expected<Comparison> compare(const nlohmann::ordered_json& before,
                                           std::string_view method_before,
                                           const nlohmann::ordered_json& after,
                                           std::string_view method_after);

/// For people: one line a measure.
[[nodiscard]] std::string comparison_text(const Comparison& comparison);
[[nodiscard]] nlohmann::ordered_json comparison_json(const Comparison& comparison);

}  // namespace terracut::evaluation
