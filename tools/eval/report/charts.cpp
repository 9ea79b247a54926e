// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>
#include <vector>

#include "html.hpp"
#include "paper_tables.hpp"
#include "plot.hpp"

namespace terracut::evaluation::report {
namespace {

/// Told apart by people who confuse red and green, too (Okabe, Ito).
constexpr std::array<std::string_view, 8> kMethodColours{
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b", "#56b4e9", "#444444", "#882255"};

std::string_view colour_of_method(std::size_t index) {
  return kMethodColours[index % kMethodColours.size()];
}

std::string legend(const Json& evaluation) {
  std::string html = "<p class=\"legend\">";
  std::size_t index = 0;
  for (const auto& [name, method] : evaluation.at("methods").items()) {
    html += fmt::format(R"(<span><i style="background:{}"></i>{}</span> )",
                        colour_of_method(index++), escaped(name));
  }
  return html + "</p>\n";
}

constexpr std::string_view kSpread[] = {"min", "mean", "max"};

std::string recall_plot(const Json& evaluation) {
  const Json& methods = evaluation.at("methods");
  const Json& sequences = methods.front().at("sequences");
  double least = 1;
  for (const auto& [method, value] : methods.items()) {
    for (const auto& [sequence, of_sequence] : sequences.items()) {
      least = std::min(least, number_at(evaluation, {"methods", method, "sequences", sequence,
                                                     "frame_recall_o", "min"})
                                  .value_or(1));
    }
  }
  const auto count = static_cast<double>(sequences.size());
  Plot plot(1080, 330, {0, count}, {std::floor(least * 10) * 10, 100},
            "Least, mean and largest Recall_o of the frames of every sequence");
  plot.y_axis("Recall_o of frames [%]");
  double left = 0;
  for (const auto& [sequence, of_sequence] : sequences.items()) {
    plot.x_label(left + 0.5, sequence);
    std::size_t index = 0;
    for (const auto& [method, value] : methods.items()) {
      const double place =
          left + 0.5 +
          (static_cast<double>(index) + 0.5 - static_cast<double>(methods.size()) / 2) *
              std::min(0.8 / static_cast<double>(methods.size()), 0.12);
      const std::string_view colour = colour_of_method(index++);
      const auto at = [&](std::string_view which) {
        return number_at(evaluation, {"methods", method, "sequences", sequence, "frame_recall_o",
                                      std::string(which)});
      };
      const auto low = at("min"), mean = at("mean"), high = at("max");
      if (!low || !mean || !high) continue;
      const double x = plot.x(place);
      plot.svg().line(x, plot.y(100 * *low), x, plot.y(100 * *high), colour, 3);
      plot.svg().disc(x, plot.y(100 * *mean), 4.5, colour,
                      fmt::format("{}, {}: {:.2f} / {:.2f} / {:.2f} %", method, sequence,
                                  100 * *low, 100 * *mean, 100 * *high));
    }
    ++left;
  }
  return plot.svg().element();
}

/// Times of a method's frames, in the order of sequences and frames.
std::vector<double> times_of(const Json& method) {
  std::vector<double> times;
  for (const Json& frame : method.at("frames")) times.push_back(frame.at("ms").get<double>());
  return times;
}

/// Every frame where there is room; where there is not, neighbours share a stroke from the least
/// of their times to the largest.
std::string time_series(const std::vector<double>& times, double largest, std::string_view colour) {
  constexpr std::size_t kMostStrokes = 600;
  const auto frames = static_cast<double>(times.size());
  Plot plot(700, 210, {0, frames}, from_zero(largest), "Time of every frame");
  plot.y_axis("time [ms]");
  plot.x_axis("frame, sequence after sequence");
  const std::size_t strokes = std::min(kMostStrokes, times.size());
  std::string path;
  for (std::size_t stroke = 0; stroke < strokes; ++stroke) {
    const auto first = times.begin() + static_cast<std::ptrdiff_t>(stroke * times.size() / strokes);
    const auto last =
        times.begin() + static_cast<std::ptrdiff_t>((stroke + 1) * times.size() / strokes);
    const auto [low, high] = std::minmax_element(first, last);
    const double middle = static_cast<double>(first - times.begin() + (last - times.begin())) / 2;
    fmt::format_to(std::back_inserter(path), "M{:.1f} {:.1f}V{:.1f}", plot.x(middle), plot.y(*low),
                   plot.y(*high));
  }
  plot.svg().stroke(path, colour, strokes > 200 ? 1.2 : 5);
  return plot.svg().element();
}

std::string time_histogram(const std::vector<double>& times, double largest,
                           std::string_view colour) {
  const AxisRange x = from_zero(largest);
  constexpr std::size_t kBins = 40;
  std::array<std::size_t, kBins> count{};
  for (const double time : times) {
    ++count[std::min(static_cast<std::size_t>(time / x.to * kBins), kBins - 1)];
  }
  Plot plot(370, 210, x, from_zero(static_cast<double>(*std::ranges::max_element(count))),
            "How the times are distributed");
  plot.y_axis("frames");
  plot.x_axis("time [ms]");
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    if (count[bin] == 0) continue;
    const double from = x.to * static_cast<double>(bin) / kBins;
    const double to = x.to * static_cast<double>(bin + 1) / kBins;
    const double top = plot.y(static_cast<double>(count[bin]));
    plot.svg().rectangle(plot.x(from), top, plot.x(to) - plot.x(from) - 0.5, plot.y(0) - top,
                         colour,
                         fmt::format("{} frames from {:.3g} to {:.3g} ms", count[bin], from, to));
  }
  return plot.svg().element();
}

/// Decoding and stages that any method has, in the order they are reported.
std::vector<std::string> stages_of(const Json& methods) {
  std::vector<std::string> stages;
  for (const auto& [name, method] : methods.items()) {
    for (const auto& [stage, times] : method.at("ms").items()) {
      if (stage != "segment" && std::ranges::find(stages, stage) == stages.end()) {
        stages.push_back(stage);
      }
    }
  }
  return stages;
}

/// The median time of every stage, by method.
std::string stage_table(const Json& evaluation) {
  const MeasuredCells cells(evaluation);
  const Json& methods = evaluation.at("methods");
  const std::vector<std::string> stages = stages_of(methods);
  std::string html =
      "<h3>By stage</h3>\n<p>Medians. A rival's time stands under the stage of ours that is most "
      "like it. Decoding is not part of the times above.</p>\n<div class=\"wide\"><table><thead>"
      "<tr><th>method</th>";
  for (const std::string& stage : stages) html += fmt::format("<th>{} [ms]</th>", escaped(stage));
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& [name, method] : methods.items()) {
    html += fmt::format(R"(<tr><th scope="row">{}</th>)", escaped(name));
    for (const std::string& stage : stages) html += cells.ms({"methods", name, "ms", stage, "p50"});
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

/// Which frame took longest.
std::string worst_place(const Json& method) {
  const Json& frames = method.at("frames");
  const auto worst = std::ranges::max_element(
      frames, {}, [](const Json& frame) { return frame.at("ms").get<double>(); });
  if (worst == frames.end()) return "–";
  return escaped(worst->at("sequence").get<std::string>() + "/" +
                 worst->at("frame").get<std::string>());
}

}  // namespace

std::string recall_section(const Json& evaluation) {
  const MeasuredCells cells(evaluation);
  const Json& methods = evaluation.at("methods");
  std::string html =
      "<section id=\"recall\"><h2>How far every frame can be relied on (Fig. 15)</h2>\n<p>Strokes "
      "go from the worst to the best frame of a sequence, dots are the mean of frames. Frames "
      "without key obstacles have no Recall<sub>o</sub>. The paper prints no numbers with its "
      "Fig. 15.</p>\n" +
      legend(evaluation) + "<div class=\"wide\">" + recall_plot(evaluation) +
      "</div>\n<details><summary>The numbers</summary><div class=\"wide\"><table><thead>"
      "<tr><th></th><th></th>";
  for (const auto& [sequence, value] : methods.front().at("sequences").items()) {
    html += fmt::format("<th>{}</th>", escaped(sequence));
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const auto& [method, value] : methods.items()) {
    for (const std::string_view which : kSpread) {
      html += fmt::format(R"(<tr{}><th scope="row">{}</th><td class="what">{}</td>)",
                          which == "min" ? " class=\"first\"" : "",
                          which == "min" ? escaped(method) : "", which);
      for (const auto& [sequence, of_sequence] : value.at("sequences").items()) {
        html += cells.percent(
            {"methods", method, "sequences", sequence, "frame_recall_o", std::string(which)});
      }
      html += "</tr>\n";
    }
  }
  return html + "</tbody></table></div></details></section>\n";
}

std::string time_section(const Json& evaluation) {
  const MeasuredCells cells(evaluation);
  const Json& methods = evaluation.at("methods");
  std::string html = fmt::format(
      "<section id=\"time\"><h2>Time of every frame (Fig. 18, 21)</h2>\n<p>Processor time of the "
      "segmentation alone. The worst of the paper's 24,534 frames took it {} ms on an i7-3770; "
      "its Fig. 21 is the same of a vehicle's own 7,504 frames, which were not published. Every "
      "method has a scale of its own.</p>\n<div class=\"wide\"><table><thead><tr><th>method"
      "</th><th>mean [ms]</th><th>median [ms]</th><th>99 % [ms]</th><th>worst [ms]</th>"
      "<th>worst frame</th></tr></thead>\n<tbody>\n",
      kPaperWorstFrame_ms);
  for (const auto& [name, method] : methods.items()) {
    html += fmt::format(R"(<tr><th scope="row">{}</th>)", escaped(name));
    for (const char* const which : {"mean", "p50", "p99", "max"}) {
      html += cells.ms({"methods", name, "ms", "segment", which});
    }
    html += fmt::format("<td>{}</td></tr>\n", worst_place(method));
  }
  html += "</tbody></table></div>\n" + stage_table(evaluation);
  std::size_t index = 0;
  for (const auto& [name, method] : methods.items()) {
    const std::string_view colour = colour_of_method(index++);
    const std::vector<double> times = times_of(method);
    if (times.empty()) continue;
    const double largest = *std::ranges::max_element(times);
    html +=
        fmt::format("<h3>{}</h3><div class=\"pair\">{}{}</div>\n", escaped(name),
                    time_series(times, largest, colour), time_histogram(times, largest, colour));
  }
  return html + "</section>\n";
}

}  // namespace terracut::evaluation::report
