// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "rt/error.hpp"
#include "tools/eval/class_table.hpp"
#include "tools/eval/evaluation.hpp"

namespace terracut::evaluation {

/// What the report is made from. Everything must outlive the call it is given to.
struct ReportInput {
  const nlohmann::ordered_json& evaluation;  ///< evaluation_json()
  const EvaluationConfig& config;            ///< Frames are read and labelled again for pictures.
  const ClassTable& classes;
  /// False: there are no files from which frames could be read again (simulated drives). The page
  /// then says so in place of pictures and cells.
  bool on_disk = true;
};

/// The evaluation as one HTML page for people, that loads nothing from anywhere: the paper's tables
/// and figures with what was measured beside what it prints, pictures of the middle and the worst
/// frame of every sequence, and how returns are spread over the cells of grids. `methods` of the
/// evaluation must have at least one frame each, else kNothingCameOut. Frames that cannot be read
/// again are named in their place. `on_progress(done, of)` counts frames.
[[nodiscard]] Expected<std::string> report_page(
    const ReportInput& input, const std::function<void(std::size_t, std::size_t)>& on_progress);

/// Writes it to `folder`/index.html, whole or not at all. Also kWriteFailed.
[[nodiscard]] Status write_report(const std::filesystem::path& folder, const ReportInput& input,
                                  const std::function<void(std::size_t, std::size_t)>& on_progress);

}  // namespace terracut::evaluation
