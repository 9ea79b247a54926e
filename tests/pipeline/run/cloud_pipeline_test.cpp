// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/run/cloud_pipeline.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "pipeline/ground/mount_search.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "tests/firmware_io/scan/synthetic_scan.hpp"

namespace terracut::run {
namespace {

using frame::Label;

class CloudPipelineTest : public testing::Test {
 protected:
  std::unique_ptr<CloudPipeline> pipeline(bool heights = false) const {
    ground::SegmenterConfig method = ground::terracut_profile();
    method.gives_heights = heights;
    return std::make_unique<CloudPipeline>(
        rows_, scan::ring_profile(rows_.rings.table, mount::Mount{.height_m = 1.73}),
        ground::maker_of(method));
  }

  std::vector<scan::ScanPoint> cloud_ = synthetic::scan(synthetic::table());
  cloud::SensorRows rows_ = cloud::learn_rows(1, [&](std::size_t) -> Expected<cloud::CloudView> {
                              return cloud::CloudView{cloud_};
                            }).value();
};

TEST_F(CloudPipelineTest, LabelsEveryPointAndSaysHowManyAreWhat) {
  const auto way = pipeline();
  status::FrameRecord record;
  ASSERT_TRUE(way->label({cloud_}, record));
  const auto& labels = way->point_labels();
  ASSERT_EQ(labels.size(), cloud_.size());
  EXPECT_EQ(std::ranges::count(labels, Label::kNone), 0);
  EXPECT_EQ(record.info.returns, cloud_.size());
  EXPECT_EQ(record.segmentation.returns, cloud_.size());
  EXPECT_EQ(record.segmentation.ground, std::ranges::count_if(labels, frame::is_ground));
  EXPECT_GT(record.segmentation.ground, cloud_.size() / 4);
  EXPECT_GT(record.segmentation.obstacles, cloud_.size() / 4);
  EXPECT_GT(record.stages.sum_ns(), 0);
}

TEST_F(CloudPipelineTest, APointThatIsNoReturnHasNoLabelAndIsNotCounted) {
  const auto way = pipeline();
  const std::size_t points = cloud_.size();
  cloud_[7].x_m = std::numeric_limits<float>::quiet_NaN();
  status::FrameRecord record;
  ASSERT_TRUE(way->label({cloud_}, record));
  EXPECT_EQ(way->point_labels()[7], Label::kNone);
  EXPECT_EQ(way->placed().no_place, 1U);
  EXPECT_EQ(record.info.returns, points - 1);
  EXPECT_EQ(record.segmentation.labelled(), points - 1);
}

TEST_F(CloudPipelineTest, EveryPointThatIsAReturnHasAHeightWhereHeightsAreAskedFor) {
  cloud_[7].x_m = std::numeric_limits<float>::quiet_NaN();
  status::FrameRecord record;
  const auto without = pipeline();
  ASSERT_TRUE(without->label({cloud_}, record));
  EXPECT_TRUE(without->point_heights_m().empty());
  const auto way = pipeline(true);
  ASSERT_TRUE(way->label({cloud_}, record));
  EXPECT_EQ(way->point_labels(), without->point_labels());
  const std::vector<float>& heights_m = way->point_heights_m();
  ASSERT_EQ(heights_m.size(), cloud_.size());
  EXPECT_TRUE(std::isnan(heights_m[7]));
  EXPECT_EQ(std::ranges::count_if(heights_m, [](float h) { return std::isnan(h); }), 1);
  EXPECT_EQ(way->heights_m().size(), way->labels().size());
  EXPECT_EQ(heights_m[9], way->heights_m()[8]) << "the return after the point that is none";
}

TEST_F(CloudPipelineTest, LabelsAndTruthOfReturnsAreThoseOfTheirPoints) {
  const auto way = pipeline();
  std::vector<std::uint32_t> truth(cloud_.size());
  for (std::size_t i = 0; i < truth.size(); ++i) truth[i] = static_cast<std::uint32_t>(3 * i);
  status::FrameRecord record;
  ASSERT_TRUE(way->label({cloud_}, record));
  const auto of_returns = way->truth_of_returns(truth);
  ASSERT_EQ(of_returns.size(), way->labels().size());
  ASSERT_EQ(way->labels().size(), way->image().returns());
  for (std::size_t i = 0; i < of_returns.size(); ++i) {
    ASSERT_EQ(way->labels()[i], way->point_labels()[of_returns[i] / 3]);
  }
  EXPECT_TRUE(way->truth_of_returns({}).empty());
}

TEST_F(CloudPipelineTest, ACloudWithoutWhatTellsItsLasersIsRefusedAndTheNextIsLabelledAsBefore) {
  const auto ring = static_cast<std::size_t>(synthetic::World{}.points_per_ring);
  std::vector<std::uint16_t> laser(cloud_.size());
  for (std::size_t i = 0; i < laser.size(); ++i) laser[i] = static_cast<std::uint16_t>(i / ring);
  const cloud::CloudView numbered{cloud_, laser};
  rows_ = cloud::learn_rows(1, [&](std::size_t) -> Expected<cloud::CloudView> {
            return numbered;
          }).value();
  const auto way = pipeline();
  status::FrameRecord record;
  ASSERT_TRUE(way->label(numbered, record));
  const std::vector<Label> before = way->point_labels();
  EXPECT_EQ(way->label({cloud_}, record).error().code, ErrorCode::kMalformed);
  ASSERT_TRUE(way->label(numbered, record));
  EXPECT_EQ(way->point_labels(), before);
}

TEST_F(CloudPipelineTest, AMountIsFoundInImagesWithoutLabels) {
  memory::FixedMemory memory;
  cloud::CloudToImage to_image(rows_, mount::kAtTheSensor, memory);
  ground::MountSearch search;
  ASSERT_TRUE(to_image.place({cloud_}));
  search.add_frame(to_image.image());
  const auto found = search.found();
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->mount.height_m, 1.73, 0.05);
}

}  // namespace
}  // namespace terracut::run
