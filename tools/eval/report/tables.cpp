// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "html.hpp"
#include "paper_tables.hpp"

namespace terracut::evaluation::report {
namespace {

std::string header(std::string_view text) {
  return fmt::format("<th>{}</th>", text);
}

/// A row's first cells: whose, and what of it.
std::string row_name(std::string_view name, std::string_view what) {
  return fmt::format(R"(<th scope="row">{}</th><td class="what">{}</td>)", escaped(name), what);
}

std::string oracle_title(std::string_view name) {
  return name == "everything_ground" ? "oracle: everything is ground"
                                     : "oracle: perfect on all physical ground";
}

constexpr std::string_view kAllGround = "IoU<sub>g</sub>, all ground";
constexpr std::string_view kRoadGround = "IoU<sub>g</sub>, road alone";

/// All methods in the order of the evaluation.
std::vector<std::string> method_names(const Json& evaluation) {
  std::vector<std::string> names;
  for (const auto& [name, method] : evaluation.at("methods").items()) names.push_back(name);
  return names;
}

/// Which of the evaluated sequences is the paper's, whose maps are called ForestMap for short;
/// none: empty.
std::string evaluated_name(const Json& sequences, std::string_view printed) {
  for (const auto& [name, sequence] : sequences.items()) {
    if (name.ends_with(printed)) return name;
  }
  return "";
}

/// One of Tables IV to IX.
class SequenceTable {
 public:
  /// A line of measured numbers of a method: what it shows, and where in a sequence and in the
  /// method the numbers lie.
  struct Line {
    std::string_view what;
    Path in_sequence, in_method;
  };

  SequenceTable(const Json& evaluation, const PaperDataset& dataset, const PaperTable& table,
                bool share)
      : evaluation_(evaluation),
        cells_(evaluation),
        dataset_(dataset),
        table_(table),
        share_(share),
        sequences_(evaluation.at("methods").front().at("sequences")) {
    for (const auto& printed : dataset.sequences)
      names_.push_back(evaluated_name(sequences_, printed));
  }

  [[nodiscard]] std::string html(const std::vector<Line>& lines, const std::vector<Line>& oracle,
                                 std::string_view unit) const {
    std::string html = fmt::format(
        "<h3>Table {}: {} [{}]</h3>\n<div class=\"wide\"><table><thead><tr><th></th><th></th>",
        table_.number, table_.caption, unit);
    for (const auto& sequence : dataset_.sequences) html += header(escaped(sequence));
    html += "<th>mean</th><th>mean of those<br>measured here</th></tr></thead>\n<tbody>\n";
    html += scans();
    for (const std::string& method : method_names(evaluation_)) {
      html += measured_rows(method, lines);
      if (const PaperRow* const row = table_.row_of(method)) html += printed_row(method, *row);
    }
    for (const PaperRow& row : table_.rows) {
      if (!evaluation_.at("methods").contains(row.method)) {
        html += printed_row(std::string(row.method), row);
      }
    }
    if (!oracle.empty()) html += oracle_rows(oracle);
    return html + "</tbody></table></div>\n";
  }

 private:
  [[nodiscard]] std::string scans() const {
    const std::string first = evaluation_.at("methods").items().begin().key();
    std::string html = "<tr>" + row_name("scans", "measured here");
    for (const std::string& name : names_) {
      html += name.empty() ? empty_cell()
                           : cells_.count({"methods", first, "sequences", name, "frames"});
    }
    html += empty_cell() + empty_cell() + "</tr>\n<tr>" + row_name("", "the paper");
    for (const int scans : dataset_.scans) {
      html += fmt::format(R"(<td class="paper">{}</td>)", scans);
    }
    return html + empty_cell() + empty_cell() + "</tr>\n";
  }

  [[nodiscard]] std::string cell(const Path& path) const {
    return share_ ? cells_.percent(path) : cells_.ms(path);
  }

  [[nodiscard]] std::string measured_rows(const std::string& method,
                                          const std::vector<Line>& lines) const {
    std::string html;
    for (const Line& line : lines) {
      html += fmt::format("<tr{}>", &line == &lines.front() ? " class=\"first\"" : "");
      html += row_name(&line == &lines.front() ? method : "", line.what);
      for (const std::string& name : names_) {
        Path path{"methods", method, "sequences", name};
        path.insert(path.end(), line.in_sequence.begin(), line.in_sequence.end());
        html += name.empty() ? empty_cell() : cell(path);
      }
      Path mean{"methods", method};
      mean.insert(mean.end(), line.in_method.begin(), line.in_method.end());
      html += empty_cell() + cell(mean) + "</tr>\n";
    }
    return html;
  }

  /// The paper's mean is over all its sequences; ours of the same ones can only be had from its
  /// printed numbers.
  [[nodiscard]] std::string printed_row(const std::string& method, const PaperRow& row) const {
    const bool measured = evaluation_.at("methods").contains(method);
    std::string html = "<tr>" + row_name(measured ? "" : method, "the paper");
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < row.values.size(); ++i) {
      html += paper_cell(row.values[i]);
      if (names_[i].empty()) continue;
      sum += row.values[i];
      ++count;
    }
    html += paper_cell(row.mean);
    return html + (count == 0 ? empty_cell() : paper_cell(sum / count)) + "</tr>\n";
  }

  [[nodiscard]] std::string oracle_rows(const std::vector<Line>& lines) const {
    std::string html;
    for (const auto& [name, oracle] : evaluation_.at("oracles").items()) {
      for (const Line& line : lines) {
        html += fmt::format("<tr class=\"oracle{}\">", &line == &lines.front() ? " first" : "");
        html += row_name(&line == &lines.front() ? oracle_title(name) : "", line.what);
        for (std::size_t i = 0; i <= names_.size(); ++i) html += empty_cell();
        Path path{"oracles", name};
        path.insert(path.end(), line.in_method.begin(), line.in_method.end());
        html += cell(path) + "</tr>\n";
      }
    }
    return html;
  }

  const Json& evaluation_;
  MeasuredCells cells_;
  const PaperDataset& dataset_;
  const PaperTable& table_;
  bool share_;
  const Json& sequences_;
  std::vector<std::string> names_;  ///< By the paper's sequence; empty: not evaluated.
};

const PaperAverage* average_of(std::string_view method) {
  const auto averages = paper_averages();
  const auto row = std::ranges::find(averages, method, &PaperAverage::method);
  return row == averages.end() ? nullptr : &*row;
}

std::string paper_average_cells(const PaperAverage* row) {
  if (row == nullptr) return empty_cell() + empty_cell() + empty_cell();
  return paper_cell(row->iou_g_percent) + paper_cell(row->recall_o_percent) +
         paper_cell(row->time_ms);
}

}  // namespace

std::string average_section(const Json& evaluation) {
  const MeasuredCells cells(evaluation);
  std::string html =
      "<section id=\"average\"><h2>Averages (Table III)</h2>\n"
      "<p>Means over sequences, times over all frames. The paper's columns are its means over "
      "<em>both</em> "
      "datasets on an i7-3770, with what its numbers imply is the road alone as ground: its IoU "
      "can be held against the column <em>road alone</em> only, and only as far as the scans are "
      "the same. Its times can be compared in their order, not in their size.</p>\n"
      "<div class=\"wide\"><table><thead><tr><th rowspan=\"2\">method</th>"
      "<th rowspan=\"2\" class=\"what\">what it is</th><th colspan=\"5\">measured here</th>"
      "<th colspan=\"3\" class=\"paper\">the paper, Table III</th></tr>\n<tr>";
  for (const std::string_view title :
       {"IoU<sub>g</sub> [%]<br>all ground", "IoU<sub>g</sub> [%]<br>road alone",
        "Recall<sub>o</sub> [%]", "mean [ms]", "max [ms]", "IoU<sub>g</sub> [%]",
        "Recall<sub>o</sub> [%]", "mean [ms]"}) {
    html += header(title);
  }
  html += "</tr></thead>\n<tbody>\n";
  const auto measured = [&](const Path& owner, const Path& means) {
    const auto at = [&](std::string_view scope, std::string_view measure) {
      Path path = owner;
      path.insert(path.end(), means.begin(), means.end());
      path.emplace_back(scope);
      path.emplace_back(measure);
      return cells.percent(path);
    };
    return at("all", "iou_g") + at("road", "iou_g") + at("all", "recall_o");
  };
  for (const auto& [name, method] : evaluation.at("methods").items()) {
    html += fmt::format("<tr>{}", row_name(name, escaped(method.at("about").get<std::string>())));
    html += measured({"methods", name}, {"mean_over_sequences"});
    html += cells.ms({"methods", name, "ms", "segment", "mean"});
    html += cells.ms({"methods", name, "ms", "segment", "max"});
    html += paper_average_cells(average_of(name)) + "</tr>\n";
  }
  for (const PaperAverage& row : paper_averages()) {
    if (evaluation.at("methods").contains(row.method)) continue;
    html += fmt::format("<tr>{}", row_name(row.method, "not measured here"));
    for (int i = 0; i < 5; ++i) html += empty_cell();
    html += paper_average_cells(&row) + "</tr>\n";
  }
  for (const auto& [name, oracle] : evaluation.at("oracles").items()) {
    html += fmt::format("<tr class=\"oracle\">{}",
                        row_name(oracle_title(name), "what such a detector would score"));
    html += measured({"oracles", name}, {});
    for (int i = 0; i < 5; ++i) html += empty_cell();
    html += "</tr>\n";
  }
  return html + "</tbody></table></div></section>\n";
}

std::string sequence_section(const Json& evaluation) {
  const auto name = evaluation.at("dataset").get<std::string>();
  const PaperDataset* const dataset = paper_dataset(name);
  if (dataset == nullptr) {
    return fmt::format(
        "<section id=\"sequences\"><h2>By sequence (Tables IV to IX)</h2>\n<p>The paper does not "
        "measure on {}: there is nothing to set beside these numbers.</p></section>\n",
        escaped(name));
  }
  std::string html = fmt::format(
      "<section id=\"sequences\"><h2>By sequence (Tables {} to {})</h2>\n"
      "<p>Grey: as the paper prints it. Its IoU<sub>g</sub> can be held against <em>road "
      "alone</em> only. Its means are over all its sequences; the last column is the mean of those "
      "that were measured here, the paper's too, from its printed numbers. Sequences of few scans "
      "say little: look at the first two rows.</p>\n",
      dataset->iou_g.number, dataset->time.number);
  const SequenceTable iou(evaluation, *dataset, dataset->iou_g, true);
  html += iou.html({{kAllGround, {"all", "iou_g"}, {"mean_over_sequences", "all", "iou_g"}},
                    {kRoadGround, {"road", "iou_g"}, {"mean_over_sequences", "road", "iou_g"}}},
                   {{kAllGround, {}, {"all", "iou_g"}}, {kRoadGround, {}, {"road", "iou_g"}}}, "%");
  const SequenceTable recall(evaluation, *dataset, dataset->recall_o, true);
  html += recall.html(
      {{"measured here", {"all", "recall_o"}, {"mean_over_sequences", "all", "recall_o"}}},
      {{"", {}, {"all", "recall_o"}}}, "%");
  const SequenceTable time(evaluation, *dataset, dataset->time, false);
  html += time.html({{"measured here", {"ms", "mean"}, {"ms", "segment", "mean"}}}, {}, "ms");
  return html +
         "<p>Key obstacles are the same classes under both definitions of ground, so "
         "Recall<sub>o</sub> "
         "has one row. The mean time is over all frames.</p></section>\n";
}

std::string range_section(const Json& evaluation) {
  const MeasuredCells cells(evaluation);
  const Json& bands = evaluation.at("methods").front().at("by_range");
  std::string html =
      "<section id=\"range\"><h2>By distance</h2>\n<p>All frames together, all ground. Not in "
      "the paper.</p>\n<div class=\"wide\"><table><thead><tr><th></th><th></th>";
  for (const auto& [band, measures] : bands.items()) html += header(escaped(band));
  html += "</tr></thead>\n<tbody>\n";
  for (const std::string& method : method_names(evaluation)) {
    for (const std::string measure : {"iou_g", "recall_o"}) {
      const bool first = measure == "iou_g";
      html += first ? "<tr class=\"first\">" : "<tr>";
      html +=
          row_name(first ? method : "", first ? "IoU<sub>g</sub> [%]" : "Recall<sub>o</sub> [%]");
      for (const auto& [band, measures] : bands.items()) {
        html += cells.percent({"methods", method, "by_range", band, measure});
      }
      html += "</tr>\n";
    }
  }
  return html + "</tbody></table></div></section>\n";
}

}  // namespace terracut::evaluation::report
