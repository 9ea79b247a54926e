// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "cell_count.hpp"

#include <fmt/format.h>

#include "firmware_io/frame/each_return.hpp"
#include "pipeline/ground/profile.hpp"

namespace terracut::report {
namespace {

constexpr float kExtent_m = kAnnuli.back().to_m;

CountedGrid squares(float side_m) {
  CountedGrid grid;
  grid.name = fmt::format("squares of {} m", side_m);
  grid.make = [side_m](const mount::RingProfile&, frame::ImageShape) {
    return std::make_unique<SquareGrid>(side_m, kExtent_m);
  };
  return grid;
}

std::vector<CellTally::Sample> samples_of(const FrameReader& reader) {
  std::vector<CellTally::Sample> samples;
  frame::for_each_return(reader.image(), [&](const frame::PlacedReturn& placed) {
    auto kind = CellTally::Kind::kObstacle;
    const datasets::Role truth = reader.truth()[placed.return_index];
    if (truth == datasets::Role::kGround) kind = CellTally::Kind::kGround;
    if (truth == datasets::Role::kIgnored) kind = CellTally::Kind::kNeither;
    const frame::Return& point = placed.point;
    samples.push_back({{point.x_m, point.y_m, point.ground_range_m, placed.column}, kind});
  });
  return samples;
}

/// By distance.
Json sums_json(const CellTally& tally) {
  Json list = Json::array();
  for (std::size_t i = 0; i < kAnnuli.size(); ++i) {
    const CellSums& sums = tally.annulus(i);
    list.push_back({{"cells", sums.cells},
                    {"empty", sums.empty},
                    {"returns", sums.points},
                    {"returns_squared", sums.points_squared},
                    {"obstacles", sums.obstacles},
                    {"obstacles_on_no_ground", sums.obstacles_on_no_ground}});
  }
  return list;
}

}  // namespace

std::vector<CountedGrid> grids_to_count() {
  std::vector<CountedGrid> grids;
  for (const float side_m : {0.5F, 1.0F, 2.0F}) grids.push_back(squares(side_m));
  CountedGrid rings;
  rings.name = "rings as printed";
  rings.make = [](const mount::RingProfile& profile, frame::ImageShape shape) {
    return std::make_unique<RingCells>(ground::paper_profile().elevation_map.grid, profile, shape);
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

Json cells_json(const std::vector<CountedGrid>& grids, const CountedFrames& frames) {
  Json json{{"counted", frames.counted},
            {"faults", frames.faults},
            {"distances", Json::array()},
            {"returns_in_a_cell", kPointBinNames},
            {"grids", Json::array()}};
  for (const Annulus& annulus : kAnnuli) json["distances"].push_back(annulus.name);
  for (const CountedGrid& grid : grids) {
    json["grids"].push_back({{"name", grid.name},
                             {"recorded", sums_json(grid.recorded)},
                             {"histogram", grid.recorded.histogram()},
                             {"flat", sums_json(grid.flat)}});
  }
  return json;
}

}  // namespace terracut::report
