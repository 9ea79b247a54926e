// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "free_trials.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

#include "pipeline/free_way/free_way.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tools/lab/world/random.hpp"
#include "tools/lab/world/shape_makers.hpp"
#include "tools/research/detection/detection_bound.hpp"
#include "tools/research/hazards/beam_cast.hpp"
#include "tools/research/hazards/spots.hpp"
#include "tools/research/hazards/trial_labels.hpp"
#include "true_way.hpp"

namespace terracut::free_measures {
namespace {

using free_way::FreeWay;
using hazards::Hazard;

constexpr double kWidth_m = 0.5, kDepth_m = 0.3;  // of a box
constexpr double kPit_m = 1.0, kPitDepth_m = 1.5;
/// A pit counts where a column crosses more of it than the walk may pass over.
constexpr double kCrossed_m = 0.95;
/// Boxes and pits farther away are not put in: the contract's heights are of the nearer ones, and
/// pits matter up to 20 m.
static_assert(kRangeBins == hazards::kRangeBins.size());
constexpr std::size_t kBoxBins = 3, kPitBins = 2;
constexpr float kNone_m = std::numeric_limits<float>::infinity();

constexpr world::Substance kThing{world::Truth::kFence, world::Material::kWood};

std::uint64_t key_of(std::uint64_t key, std::string_view name) {
  for (const char letter : name) key = world::mix_keys(key, static_cast<unsigned char>(letter));
  return key;
}

Hazard box_of(double height_m) {
  return {.body = {world::box({kDepth_m / 2, 0, 0}, {kDepth_m, kWidth_m, height_m}, kThing)},
          .faces_sensor = true};
}
Hazard pit() {
  return {.hole = world::box({0, 0, -kPitDepth_m}, {kPit_m, kPit_m, kPitDepth_m}, kThing)};
}

/// Everything that is measured in one frame.
class FrameTrials {
 public:
  FrameTrials(std::span<const eval::MethodChoice> methods, const datasets::ClassTable& classes,
              const eval::LabelledByAll& seen, const hazards::LabelledFrame& frame)
      : methods_(methods),
        seen_(seen),
        frame_(frame),
        free_way_(config_, seen.profile, seen.image.shape(), memory_),
        true_m_(true_obstacles_m(frame, classes, free_way_, config_)),
        labels_(methods, frame, seen.profile) {}

  void look_as_it_is(std::size_t method, FreeCounts& counts) {
    std::int64_t shortest_ns = std::numeric_limits<std::int64_t>::max();
    for (int time = 0; time < 3; ++time) {
      const std::int64_t begun_ns = measure::thread_cpu_ns();
      free_way_.find(seen_.image, seen_.planes_of(method), seen_.labels_of(method));
      shortest_ns = std::min(shortest_ns, measure::thread_cpu_ns() - begun_ns);
    }
    ++counts.frames;
    counts.milliseconds += static_cast<double>(shortest_ns) * 1e-6;
    for (std::size_t i = 0; i < free_way_.sectors().size(); ++i) {
      const free_way::Sector& sector = free_way_.sectors()[i];
      ++counts.sectors;
      counts.seen_m += double{sector.seen_m};
      ++counts.seen_ends[static_cast<std::size_t>(sector.seen_end)];
      SectorCounts& obstacles = counts.obstacles;
      if (std::min(true_m_[i], sector.obstacle_m) > kJudged_m) {
        ++obstacles.empty;
      } else if (std::abs(sector.obstacle_m - true_m_[i]) <= kRight_m) {
        ++obstacles.right;
      } else {
        ++(sector.obstacle_m < true_m_[i] ? obstacles.nearer : obstacles.farther);
      }
    }
  }

  /// Puts a box as high as the contract of the first method says.
  void put_box(const hazards::Spots& spots, std::size_t bin, std::uint64_t key,
               std::span<FreeCounts> counts) {
    const hazards::RangeBin& range = hazards::kRangeBins[bin];
    const detection::DetectionBound bound(methods_[0].config.segmenter, seen_.profile, frame_.shape,
                                          {});
    const auto height_m = bound.least_heights_m({range.from_m, range.to_m}, {{kWidth_m}}).front();
    if (!height_m) return;
    const Hazard box = box_of(*height_m);
    world::Random random(key);
    const auto spot = spots.draw(box, hazards::GroundKind::kRoad, bin, random);
    if (!spot) return;
    const auto moved = hazards::put_in(frame_, box, *spot, key);
    std::vector<float> box_m = nearest_of(moved);
    for (std::size_t i = 0; i < box_m.size(); ++i) {
      if (box_m[i] > true_m_[i]) box_m[i] = kNone_m;  // something else stands before it
    }
    const float front_m = *std::ranges::min_element(box_m);
    if (front_m == kNone_m) return;
    labels_.label(moved);
    for (std::size_t method = 0; method < counts.size(); ++method) {
      find(method);
      float found_m = kNone_m;
      for (std::size_t i = 0; i < box_m.size(); ++i) {
        if (box_m[i] == kNone_m) continue;
        found_m = std::min(found_m, free_way_.sectors()[i].obstacle_m);
      }
      PutIn& of_bin = counts[method].boxes[bin];
      const double behind_m = double{found_m} - double{front_m};
      ++of_bin.trials;
      of_bin.failed += behind_m > double{kRight_m} ? 1 : 0;
      of_bin.nearer += behind_m < -double{kRight_m} ? 1 : 0;
      of_bin.worst_m = std::max(of_bin.worst_m, behind_m);
    }
  }

  void put_pit(const hazards::Spots& spots, std::size_t bin, std::uint64_t key,
               std::span<FreeCounts> counts) {
    world::Random random(key);
    const Hazard hole = pit();
    const auto spot = spots.draw(hole, hazards::GroundKind::kRoad, bin, random);
    if (!spot) return;
    const auto moved = hazards::put_in(frame_, hole, *spot, key);
    const std::vector<float> edge_m = near_edges(*spot);
    if (*std::ranges::min_element(edge_m) == kNone_m) return;
    labels_.label(moved);
    for (std::size_t method = 0; method < counts.size(); ++method) {
      find(method);
      double beyond_m = -1;
      for (std::size_t i = 0; i < edge_m.size(); ++i) {
        beyond_m = std::max(beyond_m, double{free_way_.sectors()[i].seen_m - edge_m[i]});
      }
      PutIn& of_bin = counts[method].pits[bin];
      ++of_bin.trials;
      of_bin.failed += beyond_m <= double{kRight_m} ? 0 : 1;
      of_bin.worst_m = std::max(of_bin.worst_m, beyond_m);
    }
  }

 private:
  void find(std::size_t method) {
    free_way_.find(labels_.image(), labels_.planes(method), labels_.of_image(method));
  }

  /// Returns by sector the nearest of the returns that count and are high enough to be an obstacle.
  [[nodiscard]] std::vector<float> nearest_of(const hazards::MovedReturns& moved) const {
    std::vector<float> nearest_m(free_way_.sectors().size(), kNone_m);
    for (const hazards::MovedReturn& one : moved) {
      if (!one.counts) continue;
      const Eigen::Vector3d at = frame_.sensor + one.range_m * frame_.beam[one.index];
      float& nearest = nearest_m[sector_of(free_way_, frame_.cell[one.index].column)];
      nearest = std::min(nearest, static_cast<float>(at.head<2>().norm()));
    }
    return nearest_m;
  }

  /// Returns by sector the distance to the pit's edge, the least of those of its columns that cross
  /// enough of the pit, as their neighbours do: beams along a side wall may end just below its top.
  /// Infinity where no column does.
  [[nodiscard]] std::vector<float> near_edges(const Eigen::Isometry3d& T_vehicle_pit) const {
    const auto columns = static_cast<std::size_t>(frame_.shape.columns);
    std::vector<float> column_m(columns), edge_m(free_way_.sectors().size(), kNone_m);
    for (std::size_t i = 0; i < columns; ++i) {
      column_m[i] = near_edge(T_vehicle_pit, static_cast<double>(i));
    }
    for (std::size_t i = 0; i < columns; ++i) {
      const float left_m = column_m[(i + columns - 1) % columns];
      const float right_m = column_m[(i + 1) % columns];
      if (std::max(left_m, right_m) == kNone_m) continue;
      float& edge = edge_m[sector_of(free_way_, static_cast<int>(i))];
      edge = std::min(edge, column_m[i]);
    }
    return edge_m;
  }

  /// Returns the distance to the pit's edge along a column; infinity if it crosses too little.
  [[nodiscard]] float near_edge(const Eigen::Isometry3d& T_vehicle_pit, double column) const {
    constexpr double kTall_m = 10;
    const Eigen::Isometry3d T_pit_vehicle = T_vehicle_pit.inverse();
    const world::Shape well = world::box({0, 0, -kTall_m}, {kPit_m, kPit_m, 2 * kTall_m}, kThing);
    const double azimuth_rad = -2 * std::numbers::pi * (column + 0.5) / frame_.shape.columns;
    const Eigen::Vector3d along(std::cos(azimuth_rad), std::sin(azimuth_rad), 0);
    const Eigen::Vector3d from(0, 0, T_vehicle_pit.translation().z());
    const auto chord =
        world::intersect(well, {T_pit_vehicle * from, T_pit_vehicle.linear() * along});
    const bool crosses = chord && chord->in_m > 0 && chord->out_m - chord->in_m >= kCrossed_m;
    return crosses ? static_cast<float>(chord->in_m) : kNone_m;
  }

  std::span<const eval::MethodChoice> methods_;
  const eval::LabelledByAll& seen_;
  const hazards::LabelledFrame& frame_;
  memory::FixedMemory memory_;
  FreeWay::Config config_;
  FreeWay free_way_;
  std::vector<float> true_m_;  // by sector
  hazards::TrialLabels labels_;
};

void add(PutIn& sum, const PutIn& more) {
  sum.trials += more.trials;
  sum.failed += more.failed;
  sum.nearer += more.nearer;
  sum.worst_m = std::max(sum.worst_m, more.worst_m);
}

void add(FreeCounts& sum, const FreeCounts& more) {
  sum.frames += more.frames;
  sum.sectors += more.sectors;
  sum.milliseconds += more.milliseconds;
  sum.seen_m += more.seen_m;
  for (std::size_t i = 0; i < sum.seen_ends.size(); ++i) sum.seen_ends[i] += more.seen_ends[i];
  sum.obstacles.right += more.obstacles.right;
  sum.obstacles.nearer += more.obstacles.nearer;
  sum.obstacles.farther += more.obstacles.farther;
  sum.obstacles.empty += more.obstacles.empty;
  for (std::size_t i = 0; i < sum.boxes.size(); ++i) {
    add(sum.boxes[i], more.boxes[i]);
    add(sum.pits[i], more.pits[i]);
  }
}

}  // namespace

void FreeTrials::look(const eval::LabelledByAll& seen) {
  const hazards::LabelledFrame frame =
      hazards::labelled_frame(seen.image, seen.truth, seen.profile.mount, classes_);
  FrameTrials of_frame(methods_, classes_, seen, frame);
  std::vector<FreeCounts> counts(methods_.size());
  for (std::size_t method = 0; method < counts.size(); ++method) {
    of_frame.look_as_it_is(method, counts[method]);
  }
  const hazards::Spots spots(frame);
  const std::uint64_t key = key_of(key_of(seed_, seen.sequence), seen.frame);
  for (std::size_t bin = 0; bin < kBoxBins && spots.has_ground(); ++bin) {
    for (int trial = 0; trial < trials_; ++trial) {
      const std::uint64_t own =
          world::mix_keys(world::mix_keys(key, bin), static_cast<std::uint64_t>(trial));
      of_frame.put_box(spots, bin, key_of(own, "box"), counts);
      if (bin < kPitBins) of_frame.put_pit(spots, bin, key_of(own, "pit"), counts);
    }
  }
  const std::scoped_lock lock(mutex_);
  for (std::size_t method = 0; method < counts.size(); ++method) {
    add(counts_[method], counts[method]);
  }
}

}  // namespace terracut::free_measures
