// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cell_section.hpp"
#include "charts.hpp"
#include "chosen_frames.hpp"
#include "html.hpp"
#include "measure_sections.hpp"
#include "page_style.hpp"
#include "picture_sections.hpp"
#include "rt/whole_file.hpp"
#include "tables.hpp"

namespace terracut::evaluation {
namespace {

using report::escaped;
using Json = nlohmann::ordered_json;

/// More say nothing new of cells, and each takes a moment.
constexpr std::size_t kFramesToCount = 200;

/// The page may load nothing, wherever it is opened.
constexpr std::string_view kHead = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'">
<title>{0}</title>
<style>
{1}</style>
</head>
<body>
<header><h1>{0}</h1>
)";

constexpr std::string_view kContents = R"(<nav><a href="#average">averages</a>
<a href="#sequences">by sequence</a> <a href="#measures">other measures</a>
<a href="#range">by distance</a> <a href="#classes">by class</a>
<a href="#recall">every frame</a> <a href="#time">times</a> <a href="#cells">cells</a>
<a href="#comparison">side by side</a> <a href="#worst">where it fails</a>
<a href="#settings">settings</a></nav>
)";

/// In place of everything that needs them.
constexpr std::string_view kNoFrames =
    "<section id=\"cells\"><h2>Pictures and cells</h2>\n<p id=\"comparison\">The frames were not "
    "kept, so none can be shown, <span id=\"worst\">not even the worst</span>, and no returns be "
    "counted over cells.</p></section>\n";

std::string text_of(const Json& evaluation, const char* key) {
  return escaped(evaluation.at(key).get<std::string>());
}

std::string facts(const Json& evaluation) {
  const Json& first = evaluation.at("methods").front();
  std::string html = fmt::format(
      "<p>terracut {}, {} frames of {} sequences in {}, {}.</p>\n", text_of(evaluation, "terracut"),
      first.at("frames").size(), first.at("sequences").size(), text_of(evaluation, "root"),
      evaluation.at("through_packets").get<bool>() ? "through packets"
                                                   : "straight into the range image");
  if (!evaluation.at("complete").get<bool>()) {
    html += fmt::format(
        "<p class=\"fault\">Not complete: the evaluation was interrupted, or files could not be "
        "evaluated ({}; see <a href=\"#settings\">below</a>).</p>\n",
        evaluation.at("faults").size());
  }
  return html +
         "<p>Two definitions of ground, whose numbers cannot be compared with each other: <em>all "
         "ground</em> is every physical ground; <em>road alone</em> is what the paper's figures "
         "imply, where sidewalks and terrain are obstacles. The oracle rows show what each leaves "
         "to be won. A dash: nothing measured, or nothing to measure.</p>\n";
}

std::string messages(const Json& list, std::string_view title) {
  if (list.empty()) return "";
  std::string html = fmt::format("<h3>{}</h3>\n<ul>\n", title);
  for (const Json& message : list) {
    html += fmt::format("<li>{}: {}</li>\n", text_of(message, "where"), text_of(message, "what"));
  }
  return html + "</ul>\n";
}

/// Points that no method could be asked about; those of the first, as they are the same for all.
std::string lost_text(const Json& evaluation) {
  const Json& lost = evaluation.at("methods").front().at("lost");
  return fmt::format(
      "<p>Points without a recovered laser: {}; that the sensor could not have sent: {}; both "
      "count "
      "as called obstacle. Points that are no place, not finite or absurdly far: {}; they count "
      "nowhere. Frames without 64 rings in order, whose rings were told by their elevations: "
      "{}.</p>\n",
      lost.at("points_without_ring").get<std::uint64_t>(),
      lost.at("points_not_placed").get<std::uint64_t>(),
      lost.at("points_not_finite").get<std::uint64_t>(),
      lost.at("frames_realigned").get<std::uint64_t>());
}

std::string settings_section(const Json& evaluation) {
  std::string html =
      "<section id=\"settings\"><h2>Settings and what went wrong</h2>\n" + lost_text(evaluation);
  for (const auto& [name, method] : evaluation.at("methods").items()) {
    html += fmt::format("<details><summary>Parameters of {}</summary><table>\n<tbody>\n",
                        escaped(name));
    if (method.contains("parameters")) {
      for (const auto& [key, value] : method.at("parameters").items()) {
        html += fmt::format(R"(<tr><th scope="row">{}</th><td>{}</td></tr>)"
                            "\n",
                            escaped(key),
                            escaped(value.is_string() ? value.get<std::string>() : value.dump()));
      }
    }
    html += "</tbody></table></details>\n";
  }
  return html + messages(evaluation.at("faults"), "Not evaluated") +
         messages(evaluation.at("warnings"), "Warnings") + "</section>\n";
}

/// What needs the frames themselves.
std::string frame_sections(const ReportInput& input,
                           const std::function<void(std::size_t, std::size_t)>& on_progress) {
  const Json& evaluation = input.evaluation;
  const Json& method = evaluation.at("methods").front();
  const auto counted = report::spread_frames(method, kFramesToCount);
  const auto middle = report::middle_frames(method);
  const auto worst =
      report::worst_frames(evaluation.at("methods").at(report::method_in_question(evaluation)));
  std::size_t done = 0;
  const auto on_frame = [&] { on_progress(++done, counted.size() + middle.size() + worst.size()); };

  const auto dataset = dataset_at(input.config.layout, input.config.root);
  report::FrameReader reader(*dataset, input.config.mount, input.classes);
  report::FramePictures pictures(input.config, reader);
  auto grids = report::grids_to_count();
  const auto counted_frames = report::count_cells(counted, reader, grids, on_frame);
  return report::cell_section(grids, counted_frames, method.at("frames").size()) +
         report::comparison_section(evaluation, middle, pictures, on_frame) +
         report::worst_section(evaluation, worst, pictures, on_frame);
}

}  // namespace

Expected<std::string> report_page(
    const ReportInput& input, const std::function<void(std::size_t, std::size_t)>& on_progress) {
  const Json& evaluation = input.evaluation;
  for (const auto& [name, method] : evaluation.at("methods").items()) {
    if (!method.at("frames").empty()) continue;
    return fail(ErrorCode::kNothingCameOut,
                fmt::format("there is no report without frames, and {} has none", name));
  }
  const std::string title = "Ground segmentation on " + text_of(evaluation, "dataset");
  return fmt::format(kHead, title, report::kPageStyle) + facts(evaluation) + "</header>\n" +
         std::string(kContents) + "<main>\n" + report::average_section(evaluation) +
         report::sequence_section(evaluation) + report::measure_section(evaluation) +
         report::range_section(evaluation) + report::class_section(evaluation) +
         report::recall_section(evaluation) + report::time_section(evaluation) +
         (input.on_disk ? frame_sections(input, on_progress) : std::string(kNoFrames)) +
         settings_section(evaluation) + "</main>\n</body>\n</html>\n";
}

Status write_report(const std::filesystem::path& folder, const ReportInput& input,
                    const std::function<void(std::size_t, std::size_t)>& on_progress) {
  const auto page = report_page(input, on_progress);
  if (!page) return tl::unexpected(page.error());
  return rt::write_whole_file(folder / "index.html", *page);
}

}  // namespace terracut::evaluation
