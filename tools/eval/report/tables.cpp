// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "html.hpp"
#include "paper_tables.hpp"
#include "table_parts.hpp"

namespace terracut::evaluation::report {
namespace {

/// For datasets that the paper does not measure on.
const PaperDataset kNotInThePaper{.name = "",
                                  .sequences = {},
                                  .scans = {},
                                  .iou_g = {"", "IoU<sub>g</sub> by sequence", {}},
                                  .recall_o = {"", "Recall<sub>o</sub> by sequence", {}},
                                  .time = {"", "Time a frame by sequence", {}}};

/// Whether an evaluated sequence is the paper's, which calls its KoblenzForestMap ForestMap, too.
bool is_paper_sequence(std::string_view name, std::string_view printed) {
  constexpr std::string_view kPrefix = "Koblenz";
  return name == printed || (name.starts_with(kPrefix) && name.substr(kPrefix.size()) == printed);
}

/// One of Tables IV to IX: the paper's sequences, then what was evaluated besides.
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
    for (const std::string_view printed : dataset.sequences) {
      titles_.emplace_back(printed);
      names_.emplace_back();
      for (const auto& [name, sequence] : sequences_.items()) {
        if (is_paper_sequence(name, printed)) names_.back() = name;
      }
    }
    for (const auto& [name, sequence] : sequences_.items()) {
      if (std::ranges::find(names_, name) != names_.end()) continue;
      titles_.push_back(name);
      names_.push_back(name);
    }
  }

  [[nodiscard]] std::string html(const std::vector<Line>& lines, const std::vector<Line>& oracle,
                                 std::string_view unit) const {
    std::string html = fmt::format(
        "<h3>{}{} [{}]</h3>\n<div class=\"wide\"><table><thead><tr><th></th><th></th>",
        in_paper() ? fmt::format("Table {}: ", table_.number) : "", table_.caption, unit);
    for (const std::string& title : titles_) html += header(escaped(title));
    if (in_paper()) html += "<th>mean</th>";
    html += "<th>mean of those<br>measured here</th></tr></thead>\n<tbody>\n";
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
  [[nodiscard]] bool in_paper() const { return !dataset_.sequences.empty(); }
  /// Under the paper's mean of all its sequences, which nothing here is.
  [[nodiscard]] std::string under_mean() const { return in_paper() ? empty_cell() : ""; }

  [[nodiscard]] std::string scans() const {
    const std::string first = evaluation_.at("methods").items().begin().key();
    std::string html = "<tr>" + row_name("scans", "measured here");
    for (const std::string& name : names_) {
      html += name.empty() ? empty_cell()
                           : cells_.count({"methods", first, "sequences", name, "frames"});
    }
    html += under_mean() + empty_cell() + "</tr>\n";
    if (!in_paper()) return html;
    html += "<tr>" + row_name("", "the paper");
    for (std::size_t i = 0; i < names_.size(); ++i) {
      html += i < dataset_.scans.size()
                  ? fmt::format(R"(<td class="paper">{}</td>)", dataset_.scans[i])
                  : empty_cell();
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
      html += under_mean() + cell(mean) + "</tr>\n";
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
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (i >= row.values.size()) {
        html += empty_cell();
        continue;
      }
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
        for (const std::string& sequence : names_) {
          Path path{"oracles", name, "sequences", sequence};
          path.insert(path.end(), line.in_sequence.begin(), line.in_sequence.end());
          html += sequence.empty() ? empty_cell() : cell(path);
        }
        Path mean{"oracles", name};
        mean.insert(mean.end(), line.in_method.begin(), line.in_method.end());
        html += under_mean() + cell(mean) + "</tr>\n";
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
  std::vector<std::string> titles_;  ///< Of the columns.
  std::vector<std::string> names_;   ///< Of their sequences; empty: not evaluated.
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
      "the same. Its times can be compared in their order, not in their size. Its Table III has "
      "the stages of its "
      "own method and the fixed grid; Bogoslavskyi and Zhang stand in the tables by sequence.</p>\n"
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
  const PaperDataset* const printed = paper_dataset(name);
  const PaperDataset& dataset = printed == nullptr ? kNotInThePaper : *printed;
  std::string html =
      printed == nullptr
          ? fmt::format(
                "<section id=\"sequences\"><h2>By sequence</h2>\n<p>The paper does not "
                "measure on {}: there is nothing to set beside these numbers.</p>\n",
                escaped(name))
          : fmt::format(
                "<section id=\"sequences\"><h2>By sequence (Tables {} to {})</h2>\n"
                "<p>Grey: as the paper prints it. Its IoU<sub>g</sub> can be held against "
                "<em>road alone</em> only. Its means are over all its sequences; the last column "
                "is the mean of those that were measured here, the paper's too, from its printed "
                "numbers. Sequences of few scans say little: look at the first two rows.</p>\n",
                dataset.iou_g.number, dataset.time.number);
  const SequenceTable iou(evaluation, dataset, dataset.iou_g, true);
  html += iou.html({{kAllGround, {"all", "iou_g"}, {"mean_over_sequences", "all", "iou_g"}},
                    {kRoadGround, {"road", "iou_g"}, {"mean_over_sequences", "road", "iou_g"}}},
                   {{kAllGround, {"all", "iou_g"}, {"all", "iou_g"}},
                    {kRoadGround, {"road", "iou_g"}, {"road", "iou_g"}}},
                   "%");
  const SequenceTable recall(evaluation, dataset, dataset.recall_o, true);
  html += recall.html(
      {{"measured here", {"all", "recall_o"}, {"mean_over_sequences", "all", "recall_o"}}},
      {{"", {"all", "recall_o"}, {"all", "recall_o"}}}, "%");
  const SequenceTable time(evaluation, dataset, dataset.time, false);
  html += time.html({{"measured here", {"ms", "mean"}, {"ms", "segment", "mean"}}}, {}, "ms");
  return html +
         "<p>Key obstacles are the same classes under both definitions of ground; "
         "Recall<sub>o</sub> "
         "is that of all ground, which differs from that of the road only where a method tells the "
         "two apart. The mean time is over all frames.</p></section>\n";
}

}  // namespace terracut::evaluation::report
