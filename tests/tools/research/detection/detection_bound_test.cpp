// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/detection/detection_bound.hpp"

#include <gtest/gtest.h>

#include <array>
#include <ostream>
#include <vector>

#include "calib/sensor_calibration.hpp"
#include "cast_boxes.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "pipeline/free_way/free_way.hpp"

namespace terracut::detection {
namespace {

using sensor::SensorModel;

constexpr double kWidth_m = 0.5;
constexpr std::array kRanges{Ranges{5, 10},  Ranges{10, 15}, Ranges{15, 20}, Ranges{20, 25},
                             Ranges{25, 30}, Ranges{30, 40}, Ranges{40, 50}};

/// A sensor at a height.
struct Mounted {
  SensorModel model;
  double height_m;

  friend void PrintTo(const Mounted& mounted, std::ostream* out) {
    *out << to_string(mounted.model) << " at " << mounted.height_m << " m";
  }

  [[nodiscard]] calib::SensorCalibration unit() const { return calib::nominal(model); }
  [[nodiscard]] mount::RingProfile profile() const {
    return calib::ring_profile(unit(), {.height_m = height_m});
  }
  [[nodiscard]] frame::ImageShape shape() const {
    memory::FixedMemory memory;
    return decode::Decoder(unit(), {.height_m = height_m}, {}, memory).shape();
  }
};

class DetectionBoundTest : public testing::TestWithParam<Mounted> {
 protected:
  using Promises = std::vector<std::optional<double>>;

  [[nodiscard]] Promises promises(const ground::SegmenterConfig& config = {},
                                  const Assumptions& assumptions = {},
                                  double width_m = kWidth_m) const {
    const DetectionBound bound(config, profile_, shape_, assumptions);
    Promises promises;
    for (const Ranges& ranges : kRanges) {
      promises.push_back(bound.least_heights_m(ranges, {{width_m}}).front());
    }
    return promises;
  }

  /// Returns how many boxes of `share` of the promised heights are missed, by ranges.
  [[nodiscard]] std::vector<int> missed(const Promises& promises, double share, double step_m) {
    std::vector<int> missed(kRanges.size());
    cast_all(promises, share, step_m,
             [&](const CastBoxes&, const Box&, bool is_found, std::size_t place) {
               missed[place] += is_found ? 0 : 1;
             });
    return missed;
  }

  /// Casts boxes of `share` of the promised heights, `step_m` apart in range, all around the
  /// sensor, and so uphill, downhill and across the slope; calls look(cast, box, is_found, place of
  /// its ranges) for each.
  template <class Look>
  void cast_all(const Promises& promises, double share, double step_m, Look look) {
    CastBoxes cast({}, profile_, shape_, {});
    world::Random random(17);
    double range_m = kRanges.front().from_m;
    while (range_m < kRanges.back().to_m) {
      std::vector<Box> boxes;
      std::vector<std::size_t> places;
      const int turn = random.pick(8);
      for (int i = 0; i < 8 && range_m < kRanges.back().to_m; ++i, range_m += step_m) {
        std::size_t place = 0;
        while (range_m >= kRanges[place].to_m) ++place;
        if (!promises[place]) continue;
        const double azimuth_rad =
            std::numbers::pi / 4 * ((3 * i + turn) % 8 + 0.1 * random.unit());
        boxes.push_back({.azimuth_rad = azimuth_rad,
                         .range_m = range_m,
                         .width_m = kWidth_m,
                         .height_m = share * *promises[place],
                         .depth_m = Assumptions{}.depth_m * random.unit()});
        places.push_back(place);
      }
      const double uphill_rad = 2 * std::numbers::pi * random.unit();
      const std::vector<bool> found = cast.are_found(boxes, uphill_rad, random.bits());
      for (std::size_t i = 0; i < boxes.size(); ++i) look(cast, boxes[i], found[i], places[i]);
    }
  }

  mount::RingProfile profile_ = GetParam().profile();
  frame::ImageShape shape_ = GetParam().shape();
};

TEST_P(DetectionBoundTest, EveryPromisedBoxIsFound) {
  constexpr double kStep_m = 0.05;
  const std::vector<int> missed_of = missed(promises(), 1, kStep_m);
  EXPECT_EQ(missed_of, std::vector<int>(kRanges.size()));
}

TEST_P(DetectionBoundTest, EveryPromisedBoxStandsInTheFreeWayAtItsDistance) {
  constexpr double kStep_m = 0.05, kWithin_m = 0.2;
  memory::FixedMemory memory;
  free_way::FreeWay free_way({}, profile_, shape_, memory);
  cast_all(promises(), 1, kStep_m, [&](const CastBoxes& cast, const Box& box, bool, std::size_t) {
    free_way.find(cast.image(), cast.method().planes(), cast.method().labels());
    const auto count = static_cast<double>(free_way.sectors().size());
    const double half_rad = std::atan(box.width_m / 2 / box.range_m);
    const auto at = [&](double azimuth_rad) {
      return static_cast<int>(std::floor(azimuth_rad / (2 * std::numbers::pi) * count));
    };
    float nearest_m = INFINITY;
    for (int i = at(box.azimuth_rad - half_rad); i <= at(box.azimuth_rad + half_rad); ++i) {
      const int sectors = static_cast<int>(count);
      const auto sector = static_cast<std::size_t>((i + sectors) % sectors);
      nearest_m = std::min(nearest_m, free_way.sectors()[sector].obstacle_m);
    }
    EXPECT_NEAR(nearest_m, box.range_m, kWithin_m) << box.height_m << " m high";
  });
}

TEST_P(DetectionBoundTest, SomeBoxesOfHalfTheHeightAreMissed) {
  const std::vector<int> missed_of = missed(promises(), 0.5, 0.1);
  EXPECT_TRUE(std::ranges::any_of(missed_of, [](int count) { return count > 0; }));
}

TEST_P(DetectionBoundTest, FollowsTheThresholds) {
  const Promises before = promises();
  const auto sum_of = [](const Promises& promises) {
    double sum_m = 0;
    for (const auto& promise : promises) sum_m += promise.value_or(DetectionBound::kMostHeight_m);
    return sum_m;
  };
  ground::SegmenterConfig higher;
  higher.elevation_map.obstacle_height_m = 0.30F;
  EXPECT_GT(sum_of(promises(higher)), sum_of(before));
  ground::SegmenterConfig steeper;
  steeper.adjacent_points.max_slope_rad = 1.5F;
  steeper.elevation_map.opening.window_m = 0.1F;
  EXPECT_GE(sum_of(promises(steeper)), sum_of(before));
  EXPECT_LT(sum_of(promises({}, {.slope = 0})), sum_of(before));
}

TEST_P(DetectionBoundTest, PromisesNothingOnGroundThatMayBeLost) {
  const Promises nothing(kRanges.size());
  EXPECT_EQ(promises(ground::paper_profile()), nothing);
  EXPECT_EQ(promises({}, {.roughness_m = 0.03}), nothing);
  EXPECT_EQ(promises({}, {.slope = 0.25}), nothing);
}

TEST_P(DetectionBoundTest, PromisesWiderBoxesNoLowerHeights) {
  const DetectionBound bound({}, profile_, shape_, {});
  for (const Ranges& ranges : kRanges) {
    double narrower_m = 0;
    for (const auto& height_m : bound.least_heights_m(ranges, {{0.6, 1.0, 1.4, 2.0}})) {
      const double here_m = height_m.value_or(DetectionBound::kMostHeight_m);
      EXPECT_GE(here_m, narrower_m) << ranges.from_m;
      narrower_m = here_m;
    }
  }
}

TEST_P(DetectionBoundTest, PromisesNothingNarrowerThanThreeColumns) {
  const double column_rad = 2 * std::numbers::pi / shape_.columns;
  EXPECT_EQ(promises({}, {}, 2.9 * column_rad * kRanges.front().to_m), Promises(kRanges.size()));
}

INSTANTIATE_TEST_SUITE_P(Sensors, DetectionBoundTest,
                         testing::Values(Mounted{SensorModel::kVlp16, 1.73},
                                         Mounted{SensorModel::kVlp32c, 3.0},
                                         Mounted{SensorModel::kHdl64e, 1.73},
                                         Mounted{SensorModel::kRuby128, 1.73}));

}  // namespace
}  // namespace terracut::detection
