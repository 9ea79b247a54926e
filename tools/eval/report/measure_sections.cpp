// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "measure_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "html.hpp"
#include "table_parts.hpp"

namespace terracut::evaluation::report {
namespace {

/// A column of measure_section().
struct Column {
  std::string_view scope, measure;
};
constexpr std::array kColumns{Column{"all", "precision"},
                              Column{"all", "recall"},
                              Column{"all", "f1"},
                              Column{"road", "precision"},
                              Column{"road", "recall"},
                              Column{"road", "f1"},
                              Column{"all_vegetation_ignored", "iou_g"},
                              Column{"all_vegetation_ignored", "f1"}};

std::string measure_row(const MeasuredCells& cells, const Path& means) {
  std::string html;
  for (const Column& column : kColumns) {
    Path path = means;
    path.emplace_back(column.scope);
    path.emplace_back(column.measure);
    html += cells.percent(path);
  }
  return html + "</tr>\n";
}

/// Where a class stands in a method's list of those it met; none: empty.
std::string place_of(const Json& method, int id) {
  const Json& classes = method.at("by_class");
  const auto found =
      std::ranges::find_if(classes, [&](const Json& entry) { return entry.at("id") == id; });
  return found == classes.end() ? "" : std::to_string(found - classes.begin());
}

/// What a class counts as under both definitions, in words.
std::string role_of(const Json& evaluation, int id) {
  for (const Json& entry : evaluation.at("classes")) {
    if (entry.at("id") != id) continue;
    const auto all = entry.at("all").get<std::string>(), road = entry.at("road").get<std::string>();
    return all == road ? all : fmt::format("{} (road: {})", all, road);
  }
  return "not in the class table";
}

}  // namespace

std::string measure_section(const Json& evaluation) {
  const MeasuredCells cells(evaluation);
  std::string html =
      "<section id=\"measures\"><h2>Other measures</h2>\n<p>Of ground returns; means over "
      "sequences, per cent. Not in the paper.</p>\n<div class=\"wide\"><table><thead>"
      "<tr><th></th><th colspan=\"3\">all ground</th><th colspan=\"3\">road alone</th>"
      "<th colspan=\"2\">vegetation ignored</th></tr>\n<tr><th>method</th>";
  for (const std::string_view title : {"precision", "recall", "F1", "precision", "recall", "F1",
                                       "IoU<sub>g</sub>, all ground", "F1, all ground"}) {
    html += header(title);
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const std::string& method : method_names(evaluation)) {
    html += fmt::format(R"(<tr><th scope="row">{}</th>)", escaped(method)) +
            measure_row(cells, {"methods", method, "mean_over_sequences"});
  }
  for (const auto& [name, oracle] : evaluation.at("oracles").items()) {
    html += fmt::format(R"(<tr class="oracle"><th scope="row">{}</th>)", oracle_title(name)) +
            measure_row(cells, {"oracles", name});
  }
  return html + "</tbody></table></div></section>\n";
}

std::string range_section(const Json& evaluation) {
  struct Line {
    std::string_view what, bands, measure;
  };
  constexpr std::array kLines{Line{kAllGround, "by_range", "iou_g"},
                              Line{kRoadGround, "by_range_road", "iou_g"},
                              Line{"Recall<sub>o</sub>", "by_range", "recall_o"}};
  const MeasuredCells cells(evaluation);
  const Json& bands = evaluation.at("methods").front().at("by_range");
  std::string html =
      "<section id=\"range\"><h2>By distance</h2>\n<p>All frames together, per cent. Not in the "
      "paper.</p>\n<div class=\"wide\"><table><thead><tr><th></th><th></th>";
  for (const auto& [band, measures] : bands.items()) html += header(escaped(band));
  html += "</tr></thead>\n<tbody>\n";
  for (const std::string& method : method_names(evaluation)) {
    for (const Line& line : kLines) {
      const bool first = &line == &kLines.front();
      html += first ? "<tr class=\"first\">" : "<tr>";
      html += row_name(first ? method : "", line.what);
      for (const auto& [band, measures] : bands.items()) {
        html += cells.percent(
            {"methods", method, std::string(line.bands), band, std::string(line.measure)});
      }
      html += "</tr>\n";
    }
  }
  return html + "</tbody></table></div></section>\n";
}

std::string class_section(const Json& evaluation) {
  const MeasuredCells cells(evaluation);
  const std::string first = method_names(evaluation).front();
  std::string html =
      "<section id=\"classes\"><h2>By class</h2>\n<p>Which share of the returns of a class is "
      "called ground, per cent, all frames together: 100 is right for ground, 0 for obstacles. Not "
      "in the paper.";
  if (any_tells_road(evaluation)) {
    html +=
        " Where a method tells the road surface from other ground, a second column has the share "
        "that is called other ground: 0 is right for roads.";
  }
  html +=
      "</p>\n<div class=\"wide\"><table><thead><tr><th>class</th>"
      "<th class=\"what\">counts as</th><th>returns</th>";
  for (const std::string& method : method_names(evaluation)) {
    html += header(escaped(method));
    if (tells_road(evaluation.at("methods").at(method))) {
      html += header("of it<br>other ground");
    }
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const Json& entry : evaluation.at("methods").at(first).at("by_class")) {
    const int id = entry.at("id").get<int>();
    const auto name = entry.at("name").get<std::string>();
    html += "<tr>" + row_name(name.empty() ? fmt::format("class {}", id) : name,
                              escaped(role_of(evaluation, id)));
    html += cells.count(
        {"methods", first, "by_class", place_of(evaluation.at("methods").at(first), id), "points"});
    for (const std::string& method : method_names(evaluation)) {
      const std::string place = place_of(evaluation.at("methods").at(method), id);
      const auto share = [&](const char* of_what) {
        return place.empty() ? empty_cell()
                             : cells.percent({"methods", method, "by_class", place, of_what});
      };
      html += share("share_as_ground");
      if (tells_road(evaluation.at("methods").at(method))) html += share("share_as_other_ground");
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div></section>\n";
}

}  // namespace terracut::evaluation::report
