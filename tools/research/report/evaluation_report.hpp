// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "rt/error.hpp"
#include "tools/research/datasets/class_table.hpp"
#include "tools/research/eval/evaluation.hpp"

namespace terracut::report {

/// The input of a report. All members must outlive the call.
struct ReportInput {
  const nlohmann::ordered_json& evaluation;  ///< evaluation_json()
  const eval::EvaluationConfig& config;      ///< Used to read and label frames again for pictures.
  const datasets::ClassTable& classes;
  /// False if there are no files from which frames could be read again (simulated drives). The
  /// report then has no pictures.
  bool on_disk = true;
};

/// Writes the input of ./tools/report: `folder`/evaluation.json, whole or not at all, and the
/// pictures it names. It is the evaluation and, for frames on disk, also
///
///   side_by_side[]   the middle frame of every sequence (DrawnFrames)
///   worst_of, worst[]  a method, and the frames where it is worst
///   colours          of the pictures (colours_json())
///
/// `on_progress(done, of)` counts frames. Fails with kNothingCameOut unless each of the
/// evaluation's `methods` has a frame; kWriteFailed if a file cannot be written.
[[nodiscard]] Status write_report(const std::filesystem::path& folder, const ReportInput& input,
                                  const std::function<void(std::size_t, std::size_t)>& on_progress);

}  // namespace terracut::report
