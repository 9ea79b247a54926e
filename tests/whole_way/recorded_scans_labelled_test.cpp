// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The method on the labelled scans beside the repository: how good it is, and that its cut is the
// optimum there.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/scan/scan_to_image.hpp"
#include "pipeline/ground/coarse_stages.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "tests/firmware_io/scan/recorded_sequences.hpp"
#include "tests/pipeline/min_cut/boost_oracle.hpp"
#include "tools/lab/encode/scan_reader.hpp"
#include "tools/lab/quality/quality.hpp"

namespace terracut::whole_way {
namespace {

using frame::ImageShape;
using frame::RangeImage;
using ground::SegmenterConfig;
using stage::Stage;

/// The scans of one sequence as range images, with the profile of their unit.
class RecordedFrames {
 public:
  explicit RecordedFrames(const std::filesystem::path& sequence)
      : reader_(encode::ScanReader::open(sequence).value()), image_(ImageShape{}, 40'000, memory_) {
    const auto fitted = reader_.fit_rings();
    profile_ = mount::ring_profile(scan::hdl64e_calibration(fitted.value().table), {});
    to_image_ = std::make_unique<scan::ScanToImage>(profile_.mount);
  }

  /// visit(image, truth of the returns in their order)
  template <class Visit>
  void for_each(Visit&& visit) {
    for (std::size_t i = 0; i < reader_.size(); ++i) {
      ASSERT_TRUE(reader_.read(i, scan_, rings_).has_value());
      const auto placed = to_image_->place(scan_.points, rings_.ring_of_point, image_);
      ASSERT_EQ(placed.overflow_full, 0U);
      std::vector<std::uint32_t> truth;
      for (const std::uint32_t point : to_image_->point_of_return()) {
        truth.push_back(scan_.labels[point]);
      }
      visit(image_, truth);
    }
  }
  [[nodiscard]] const mount::RingProfile& profile() const { return profile_; }
  [[nodiscard]] const RangeImage& image() const { return image_; }

 private:
  memory::FixedMemory memory_;
  encode::ScanReader reader_;
  RangeImage image_;
  mount::RingProfile profile_;
  std::unique_ptr<scan::ScanToImage> to_image_;
  scan::KittiScan scan_;
  scan::RingRecovery rings_;
};

struct Accuracy {
  double iou_g = 0, recall_o = 0;
};

/// Mean over sequences of each sequence's pooled value, as the paper averages.
Accuracy accuracy(const std::vector<std::filesystem::path>& sequences, SegmenterConfig config,
                  Stage last_stage, const min_cut::CutBudget& budget = {}) {
  config.last_stage = last_stage;
  Accuracy mean;
  for (const auto& sequence : sequences) {
    RecordedFrames frames(sequence);
    memory::FixedMemory memory;
    ground::Segmenter segmenter(config, frames.profile(), frames.image().shape(),
                                frames.image().return_capacity(), memory);
    quality::Quality quality;
    frames.for_each([&](const RangeImage& image, const std::vector<std::uint32_t>& truth) {
      const auto report = segmenter.segment(image, budget);
      EXPECT_EQ(report.returns, image.returns());
      quality += quality::measure(segmenter.labels(), truth);
    });
    mean.iou_g += quality.iou_ground() / static_cast<double>(sequences.size());
    mean.recall_o += quality.recall_key_obstacles() / static_cast<double>(sequences.size());
  }
  return mean;
}

TEST(RecordedScansLabelled, ReachTheirAccuracyAndEveryStageRaisesBothMeasures) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  for (const bool printed : {false, true}) {
    const SegmenterConfig config = printed ? ground::paper_profile() : ground::terracut_profile();
    const Accuracy coarse = accuracy(sequences, config, Stage::kElevationMap);
    const Accuracy finer = accuracy(sequences, config, Stage::kAdjacentPoints);
    const Accuracy fine = accuracy(sequences, config, Stage::kMinCut);
    EXPECT_GT(finer.iou_g, coarse.iou_g);
    EXPECT_GT(finer.recall_o, coarse.recall_o);
    EXPECT_GT(fine.iou_g, finer.iou_g);
    EXPECT_GT(fine.recall_o, finer.recall_o);
    if (printed) continue;
    // A little below what docs/reference/method.md states, so that noise in a later change is no
    // failure.
    EXPECT_GT(fine.iou_g, 0.945);
    EXPECT_GT(fine.recall_o, 0.980);
  }
}

/// The cut's problem for one image, by the stages before it.
test::TestProblem cut_problem(const SegmenterConfig& config, const mount::RingProfile& profile,
                              const RangeImage& image) {
  const ImageShape shape = image.shape();
  memory::FixedMemory memory;
  stage::CellPlanes planes(shape, memory);
  ground::CoarseStages coarse(config, profile, shape, memory);
  coarse.begin();
  coarse.take_to(coarse.grid().sectors(), image.points());
  coarse.label_circle(image.points(), planes);
  random_field::ConfidenceSeeds seeds(config.seeds, config.adjacent_points.row_step_deg, profile,
                                      shape, memory);
  seeds.select(planes, {0, shape.columns});
  random_field::RegionTerm region(config.region);
  region.look_at(image.points(), planes, seeds.seeds());
  const stage::NegativeExp negative_exp;
  const random_field::BoundaryTerm boundary(config.boundary, negative_exp, image.points());

  test::TestProblem problem(shape);
  problem.seeds.assign(seeds.seeds().begin(), seeds.seeds().end());
  problem.ground_range_m.assign(image.ground_range_m().begin(), image.ground_range_m().end());
  problem.coarse.assign(planes.label.begin(), planes.label.end());
  problem.for_each_cell([&](int row, int column, std::uint32_t cell) {
    if (image.has_return(cell)) {
      const min_cut::LabelCosts costs = region(cell);
      problem.cost_ground[cell] = costs.ground;
      problem.cost_obstacle[cell] = costs.obstacle;
      boundary(cell, min_cut::neighbour_cells(shape, row, column), problem.weight[cell]);
    }
  });
  return problem;
}

TEST(RecordedScansLabelled, AreCutAtTheEnergyOfAnIndependentSolver) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  for (const auto& sequence : sequences) {
    RecordedFrames frames(sequence);
    for (SegmenterConfig config : {ground::terracut_profile(), ground::paper_profile()}) {
      config.min_cut.max_unknown = 1U << 17;  // no cap: the optimum of the whole frame
      memory::FixedMemory memory;
      min_cut::GridCut cut(frames.image().shape(), config.min_cut, memory);
      frames.for_each([&](const RangeImage& image, const std::vector<std::uint32_t>&) {
        const auto problem = cut_problem(config, frames.profile(), image);
        std::vector<frame::Label> labels = problem.coarse_labelling();
        std::vector<min_cut::Seed> seeds;
        const auto report =
            cut.solve(problem.view(seeds), problem.costs(), problem.weights(), {}, labels);
        EXPECT_TRUE(report.exact());
        EXPECT_EQ(report.energy, problem.energy(labels));
        EXPECT_EQ(report.energy, test::boost_optimum(problem).energy);
        // Machine independent: what a frame may cost, several times what these do.
        EXPECT_LT(report.boykov_kolmogorov_ops + report.push_relabel_ops, 1'000'000);
      });
    }
  }
}

/// Wherever a cut is stopped: with next to nothing, with most of it finished, and between.
constexpr std::int64_t kStops[] = {0, 500, 2'000, 8'000, 16'000};

TEST(RecordedScansLabelled, AreNoWorseByAStoppedCutThanByTheCoarseStages) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  for (const float least_finished : {0.0F, 0.5F}) {
    SegmenterConfig config = ground::terracut_profile();
    config.min_cut.least_finished = least_finished;
    const Accuracy coarse = accuracy(sequences, config, Stage::kAdjacentPoints);
    for (const std::int64_t ops : kStops) {
      SCOPED_TRACE(ops);
      const Accuracy stopped = accuracy(sequences, config, Stage::kMinCut, {ops});
      EXPECT_GE(stopped.iou_g, coarse.iou_g);
      EXPECT_GE(stopped.recall_o, coarse.recall_o);
    }
  }
}

TEST(RecordedScansLabelled, AreCutToNoMoreThanTheCoarseEnergyWhereverItIsStopped) {
  TERRACUT_RECORDED_SEQUENCES(sequences);
  int stopped = 0;
  for (const auto& sequence : sequences) {
    RecordedFrames frames(sequence);
    for (SegmenterConfig config : {ground::terracut_profile(), ground::paper_profile()}) {
      config.min_cut.least_finished = 0;
      memory::FixedMemory memory;
      min_cut::GridCut cut(frames.image().shape(), config.min_cut, memory);
      frames.for_each([&](const RangeImage& image, const std::vector<std::uint32_t>&) {
        const auto problem = cut_problem(config, frames.profile(), image);
        const std::int64_t coarse_energy = problem.energy(problem.coarse_labelling());
        for (const std::int64_t ops : kStops) {
          std::vector<frame::Label> labels = problem.coarse_labelling();
          std::vector<min_cut::Seed> seeds;
          const auto report =
              cut.solve(problem.view(seeds), problem.costs(), problem.weights(), {ops}, labels);
          EXPECT_LE(problem.energy(labels), coarse_energy) << "after " << ops << " operations";
          stopped += report.budget_hit ? 1 : 0;
        }
      });
    }
  }
  EXPECT_GT(stopped, 18 * 4);
}

}  // namespace
}  // namespace terracut::whole_way
