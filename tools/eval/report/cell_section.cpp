// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "cell_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "firmware_io/sinks/each_return.hpp"
#include "html.hpp"
#include "pipeline/profile.hpp"
#include "plot.hpp"

namespace terracut::evaluation::report {
namespace {

constexpr float kExtent_m = kAnnuli.back().to_m;
constexpr std::array<std::string_view, 4> kGridColours{"#c9d3df", "#8ea3bd", "#4a6a94", "#d55e00"};

CountedGrid squares(float side_m) {
  CountedGrid grid;
  grid.name = fmt::format("squares of {} m", side_m);
  grid.make = [side_m](const calib::RingProfile&, pipeline::ImageShape) {
    return std::make_unique<SquareGrid>(side_m, kExtent_m);
  };
  return grid;
}

std::vector<CellTally::Sample> samples_of(const FrameReader& reader) {
  std::vector<CellTally::Sample> samples;
  firmware_io::for_each_return(reader.image(), [&](const firmware_io::PlacedReturn& placed) {
    auto kind = CellTally::Kind::kObstacle;
    const Role truth = reader.truth()[placed.return_index];
    if (truth == Role::kGround) kind = CellTally::Kind::kGround;
    if (truth == Role::kIgnored) kind = CellTally::Kind::kNeither;
    const pipeline::Return& echo = placed.echo;
    samples.push_back({{echo.x_m, echo.y_m, echo.ground_range_m, placed.column}, kind});
  });
  return samples;
}

std::string histogram_plot(const std::vector<CountedGrid>& grids) {
  double largest = 0;
  for (const CountedGrid& grid : grids) {
    const auto cells = static_cast<double>(grid.recorded.all().cells);
    if (cells == 0) continue;
    for (const std::uint64_t count : grid.recorded.histogram()) {
      largest = std::max(largest, 100 * static_cast<double>(count) / cells);
    }
  }
  const auto bins = static_cast<double>(kPointBinNames.size());
  Plot plot(1080, 300, {0, bins}, from_zero(largest), "Share of cells by the number of returns");
  plot.y_axis("share of the grid's cells [%]");
  for (std::size_t bin = 0; bin < kPointBinNames.size(); ++bin) {
    const double left = static_cast<double>(bin) + 0.1;
    plot.x_label(left + 0.4, kPointBinNames[bin]);
    const double width = 0.8 / static_cast<double>(grids.size());
    for (std::size_t i = 0; i < grids.size(); ++i) {
      const auto cells = static_cast<double>(grids[i].recorded.all().cells);
      if (cells == 0) continue;
      const double share = 100 * static_cast<double>(grids[i].recorded.histogram()[bin]) / cells;
      const double from = left + width * static_cast<double>(i);
      plot.svg().rectangle(plot.x(from), plot.y(share), plot.x(from + width) - plot.x(from) - 1,
                           plot.y(0) - plot.y(share), kGridColours[i % kGridColours.size()],
                           fmt::format("{}: {:.2f} % of the cells have {} returns", grids[i].name,
                                       share, kPointBinNames[bin]));
    }
  }
  plot.svg().text(plot.x(bins / 2), 294, "returns in a cell", TextAnchor::kMiddle);
  return plot.svg().element();
}

std::string legend(const std::vector<CountedGrid>& grids) {
  std::string html = "<p class=\"legend\">";
  for (std::size_t i = 0; i < grids.size(); ++i) {
    html += fmt::format(R"(<span><i style="background:{}"></i>{}</span> )",
                        kGridColours[i % kGridColours.size()], escaped(grids[i].name));
  }
  return html + "</p>\n";
}

/// Three or four columns of numbers for every annulus and for all.
std::string cells_table(const std::vector<CountedGrid>& grids, bool flat) {
  std::string html =
      "<div class=\"wide\"><table class=\"cells\"><thead><tr><th>grid</th><th>distance</th>"
      "<th>cells</th><th>empty [%]</th><th>returns<br>a cell</th>"
      "<th>coefficient<br>of variation</th>";
  if (!flat) html += "<th>obstacle returns in cells<br>without ground [%]</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (const CountedGrid& grid : grids) {
    const CellTally& tally = flat ? grid.flat : grid.recorded;
    for (std::size_t i = 0; i <= kAnnuli.size(); ++i) {
      const bool total = i == kAnnuli.size();
      const CellSums sums = total ? tally.all() : tally.annulus(i);
      html += fmt::format(R"(<tr{}><th scope="row">{}</th><td class="what">{}</td><td>{}</td>)"
                          "<td>{:.2f}</td><td>{:.2f}</td><td>{:.3f}</td>",
                          i == 0 ? " class=\"first\"" : "", i == 0 ? escaped(grid.name) : "",
                          total ? "<b>all</b>" : kAnnuli[i].name, sums.cells,
                          100 * sums.empty_share(), sums.mean_points(), sums.variation());
      if (!flat) html += fmt::format("<td>{:.2f}</td>", 100 * sums.no_ground_share());
      html += "</tr>\n";
    }
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace

std::vector<CountedGrid> grids_to_count() {
  std::vector<CountedGrid> grids;
  for (const float side_m : {0.5F, 1.0F, 2.0F}) grids.push_back(squares(side_m));
  CountedGrid rings;
  rings.name = "rings as printed";
  rings.make = [](const calib::RingProfile& profile, pipeline::ImageShape shape) {
    return std::make_unique<RingCells>(pipeline::paper_profile().elevation_map.grid, profile,
                                       shape);
  };
  grids.push_back(std::move(rings));
  return grids;
}

CountedFrames count_cells(const std::vector<ChosenFrame>& frames, FrameReader& reader,
                          std::vector<CountedGrid>& grids, const std::function<void()>& on_frame) {
  CountedFrames counted;
  std::vector<std::unique_ptr<CellGrid>> of_sequence;
  std::string sequence;
  for (const ChosenFrame& frame : frames) {
    const Status read = reader.read(frame.sequence, frame.frame);
    on_frame();
    if (!read) {
      counted.faults.push_back(read.error().message);
      continue;
    }
    if (of_sequence.empty() || sequence != frame.sequence) {
      sequence = frame.sequence;
      of_sequence.clear();
      std::vector<CellTally::Sample> flat;
      for (const GroundPlace& place : flat_world(reader.profile(), reader.image().shape())) {
        flat.push_back({place, CellTally::Kind::kGround});
      }
      for (CountedGrid& grid : grids) {
        of_sequence.push_back(grid.make(reader.profile(), reader.image().shape()));
        grid.flat.add(*of_sequence.back(), flat);
      }
    }
    const auto samples = samples_of(reader);
    for (std::size_t i = 0; i < grids.size(); ++i) grids[i].recorded.add(*of_sequence[i], samples);
    ++counted.counted;
  }
  return counted;
}

std::string cell_section(const std::vector<CountedGrid>& grids, const CountedFrames& frames,
                         std::size_t frames_in_all) {
  std::string html = fmt::format(
      "<section id=\"cells\"><h2>Returns over cells (Eq. 1, 2)</h2>\n<p>The paper argues that "
      "squares share out returns unevenly, that cells which got no ground mistake obstacles for "
      "it, and that rings do better. Counted over {} of {} frames, for cells whose middle is {} "
      "to {} m away. The coefficient of variation is the standard deviation of the returns of a "
      "cell over their mean: 0 would be an even distribution. The last column is what the "
      "argument is about: an obstacle's return in a cell without ground has nothing under it to "
      "be measured from.</p>\n",
      frames.counted, frames_in_all, kAnnuli.front().from_m, kAnnuli.back().to_m);
  for (const std::string& fault : frames.faults) {
    html += fmt::format("<p class=\"fault\">Not counted: {}</p>\n", escaped(fault));
  }
  if (frames.counted == 0) return html + "</section>\n";
  html += "<h3>Recorded frames</h3>\n" + legend(grids) + "<div class=\"wide\">" +
          histogram_plot(grids) + "</div>\n" + cells_table(grids, false);
  html +=
      "<h3>A flat, empty world</h3>\n<p>Every laser draws its circle where it meets level ground: "
      "what Eq. 1 and 2 count, here counted return by return.</p>\n" +
      cells_table(grids, true);
  return html + "</section>\n";
}

}  // namespace terracut::evaluation::report
