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

  /// As eval prints it, the mean over sequences of all their points together; none where the
  /// reports are not of the same frames, and of times.
  std::optional<double> eval_before, eval_after;

  /// By the test over frames. Never of times: those of two runs on a shared machine differ without
  /// anybody's doing.
  [[nodiscard]] bool worse(double significance) const noexcept {
    const double gain = more_is_better ? after - before : before - after;
    return measure != "ms" && gain < 0 && frames.p < significance;
  }
};

struct Comparison {
  std::string before{}, after{};  ///< What was compared: "paper of A.json".
  std::size_t frames = 0;         ///< In both.
  std::size_t only_before = 0, only_after = 0;
  std::vector<MeasureChange> changes;

  /// The measures that got worse, and not by chance: "iou_g, recall_o"; empty: none.
  [[nodiscard]] std::string worse(double significance) const;
};

/// One side of a comparison.
struct Compared {
  const nlohmann::ordered_json& report;  ///< evaluation_json().
  std::string name;                      ///< Of its file, for messages.
  std::string method;
};

/// Compares two methods over the frames that both reports have. kMalformed, naming the file and
/// what it lacks: no report, or a method it does not have; kInvalidArgument: no frame in common.
[[nodiscard]] Expected<Comparison> compare(const Compared& before, const Compared& after);

/// For people: one line a measure, and what got worse at that significance.
[[nodiscard]] std::string comparison_text(const Comparison& comparison, double significance);
[[nodiscard]] nlohmann::ordered_json comparison_json(const Comparison& comparison);

}  // namespace terracut::evaluation
