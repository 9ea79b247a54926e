// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "evaluation.hpp"
#include "rt/error.hpp"
#include "tools/research/datasets/class_table.hpp"

namespace terracut::eval {

/// The subject of an evaluation, for its report.
struct EvaluationFacts {
  std::string dataset;  ///< "semantickitti", "koblenz", "own", "simulated"
  std::string root;
  std::vector<MethodChoice> methods;
  bool through_packets = false;
};

/// Returns the whole evaluation for programs. Shares are in [0, 1], or null if undefined (no key
/// obstacle: no recall_o); times are milliseconds of processor time.
///
///   terracut, dataset, root, through_packets, classes[]
///   methods{name}
///     about, parameters{key}
///     mean_over_sequences, pooled   {all, road, all_vegetation_ignored}, each {iou_g, recall_o,
///                                   precision, recall, f1}
///                                   pooled also tall and flips, as sequences{}
///     by_range{"<20m"}              the measures under `all`; by_range_road{} under `road`
///     by_class[]                    id, name, points, as_ground, share_as_ground,
///                                   as_other_ground, share_as_other_ground: of it no road surface
///     sequences{name}               frames, points, the measures, and over frames
///                                   frame_iou_g, frame_iou_road, frame_recall_o {min, mean, max}
///                                   tall {returns, as_ground, share}: more than 0.30 m above the
///                                   true ground; flips {returns, flips, true_flips, share,
///                                   true_share}: label changes since the frame before
///     frames[]                      sequence, frame, points, iou_g, recall_o, iou_road, ms{}
///     ms{stage}                     {mean, p50, p99, max}
///     lost                          points no_ring, not_placed, non_finite; frames realigned
///   oracles{everything_ground, perfect_ground}   mean_over_sequences of each, and sequences{name}
///   faults[]    {where, what}
///   warnings[]  classes the table does not know, by the file they were first met in
///
/// `terracut eval` adds to it: simulated{sensor, returns, duration_s, seed}, the class table's note
/// as a warning, and found_mounts{sequence} {height_m, roll_deg, pitch_deg, frames}.
[[nodiscard]] nlohmann::ordered_json evaluation_json(const EvaluationFacts& facts,
                                                     const datasets::ClassTable& classes,
                                                     const EvaluationOutcome& outcome);

/// Returns a table of the methods' means, for people.
[[nodiscard]] std::string evaluation_text(const nlohmann::ordered_json& evaluation);

}  // namespace terracut::eval
