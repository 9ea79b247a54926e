// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/report/evaluation_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "rt/files/whole_file.hpp"
#include "tools/research/report/chosen_frames.hpp"
#include "tools/research/report/drawn_frames.hpp"

namespace terracut::report {
namespace {

/// Adds those parts of the report for which frames must be read again.
Status add_frames(const std::filesystem::path& folder, const ReportInput& input, Json& report,
                  const std::function<void(std::size_t, std::size_t)>& on_progress) {
  const Json& methods = input.evaluation.at("methods");
  const std::string worst_of = method_in_question(input.evaluation);
  const auto middle = middle_frames(methods.front());
  const auto worst = worst_frames(methods.at(worst_of));
  std::size_t done = 0;
  const auto on_frame = [&] { on_progress(++done, middle.size() + worst.size()); };

  const auto dataset = datasets::Dataset::at(input.config.layout, input.config.root);
  FrameReader reader(dataset.value(), input.config.mount, input.classes);
  FramePictures pictures(input.config, reader);
  DrawnFrames drawn(input.evaluation, pictures, folder, on_frame);
  const auto side_by_side = drawn.side_by_side(middle);
  if (!side_by_side) return tl::unexpected(side_by_side.error());
  const auto failures = drawn.worst(worst);
  if (!failures) return tl::unexpected(failures.error());
  report["side_by_side"] = *side_by_side;
  report["worst_of"] = worst_of;
  report["worst"] = *failures;
  report["colours"] = colours_json();
  return {};
}

}  // namespace

Status write_report(const std::filesystem::path& folder, const ReportInput& input,
                    const std::function<void(std::size_t, std::size_t)>& on_progress) {
  for (const auto& [name, method] : input.evaluation.at("methods").items()) {
    if (!method.at("frames").empty()) continue;
    return fail(ErrorCode::kNothingCameOut,
                fmt::format("there is no report without frames, and {} has none", name));
  }
  Json report = input.evaluation;
  if (input.on_disk) {
    if (const Status added = add_frames(folder, input, report, on_progress); !added) return added;
  }
  return files::write_whole_file(folder / "evaluation.json",
                                 report.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace terracut::report
