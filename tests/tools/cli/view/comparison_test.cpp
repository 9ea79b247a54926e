// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What labels are compared with: the truth, and a second set of parameters.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "eight_frames.hpp"
#include "page_fixture.hpp"
#include "tools/cli/view/capture_labels.hpp"
#include "tools/cli/view/frame_stream.hpp"
#include "tools/cli/view/played_capture.hpp"
#include "tools/cli/view/played_clouds.hpp"
#include "tools/cli/view/truth_doubt.hpp"
#include "tools/lab/drive/drive_files.hpp"

namespace terracut::cli {
namespace {

using frame::Label;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::array kOwn{Label::kGround, Label::kGround, Label::kObstacle, Label::kObstacle};
constexpr std::array kBeside{Label::kGround, Label::kObstacle, Label::kObstacle,
                             Label::kOtherGround};
constexpr std::array<std::uint32_t, 4> kTruth{40, 10, 48, 0};  // road, car, sidewalk, unlabelled

TEST(FrameComparison, HasTruthAndOtherLabelInAByte) {
  FrameComparison comparison;
  compare(kOwn, kBeside, kTruth, comparison);
  EXPECT_THAT(comparison.of_returns, ElementsAre(1 + 4, 3 + 8, 1 + 8, 0 + 12));
  EXPECT_EQ(comparison.differing, 2U);
  ASSERT_TRUE(comparison.quality && comparison.quality_beside);
  EXPECT_EQ(comparison.quality->obstacle_as_ground, 1U);
  EXPECT_EQ(comparison.quality->ground_as_obstacle, 1U);
  EXPECT_EQ(comparison.quality_beside->obstacle_as_ground, 0U);
}

TEST(FrameComparison, IsEmptyWithoutEither) {
  FrameComparison comparison;
  compare(kOwn, kBeside, kTruth, comparison);
  compare(kOwn, {}, {}, comparison);
  EXPECT_TRUE(comparison.of_returns.empty());
  EXPECT_EQ(comparison.differing, 0U);
  EXPECT_FALSE(comparison.quality || comparison.quality_beside);
  compare(kOwn, {}, kTruth, comparison);
  EXPECT_THAT(comparison.of_returns, ElementsAre(1, 3, 1, 0));
  compare(kOwn, kBeside, {}, comparison);
  EXPECT_THAT(comparison.of_returns, ElementsAre(4, 8, 8, 12));
}

TEST(TruthDoubt, RefusesTruthThatWasAskedForAndNeverFitted) {
  const Status misfit = fail(ErrorCode::kMalformed, "2 labels, but 9 returns");
  const Status none = fail(ErrorCode::kNotFound, "no such file");
  TruthDoubt asked(true), by_itself(false);
  EXPECT_TRUE(asked.judge(none));
  EXPECT_FALSE(asked.judge(misfit));
  EXPECT_TRUE(asked.judge({}));
  EXPECT_TRUE(asked.judge(misfit)) << "others fitted";
  EXPECT_TRUE(by_itself.judge(misfit));
}

class PageThatCompares : public Page {
 protected:
  PageThatCompares()
      : Page(nullptr, false, {}, {.truth = true, .name = "terracut", .beside = "b.yaml"}) {
    compare(kOwn, kBeside, kTruth, comparison_);
    sink_->put_compared(frame_of(7, 4), comparison_);
  }
  FrameComparison comparison_;
};

TEST_F(PageThatCompares, GivesAByteForEachPointToThePageAlone) {
  const auto page = browser(0, "/shown");
  const stream::FrameWireHeader header = next_frame(*page);
  EXPECT_EQ(header.flags & kFrameCompared, kFrameCompared);
  const std::string bytes = page->read(4);
  EXPECT_EQ(std::vector<std::uint8_t>(bytes.begin(), bytes.end()), comparison_.of_returns);
  const auto program = browser();
  EXPECT_EQ(next_frame(*program).flags & kFrameCompared, 0U);
  ASSERT_TRUE(sink_->put(frame_of(8, 4)));
  for (const auto& reader : {page.get(), program.get()}) {
    const stream::FrameWireHeader next = next_frame(*reader);
    EXPECT_EQ(next.number, 8U);
    EXPECT_EQ(next.flags & kFrameCompared, 0U) << "nothing is known to compare it with";
  }
}

TEST_F(PageThatCompares, TellsHowRightEachIs) {
  EXPECT_EQ(figures().at("compared"),
            json::parse(R"({"truth": true, "names": ["terracut", "b.yaml"]})"));
  const json found = json::parse(get("/found/7").body);
  EXPECT_EQ(found.at("differing"), 2);
  EXPECT_EQ(found.at("scores"), json::parse(R"([
      {"iou_g": 0.33333, "recall_o": 0, "missed": 1, "false": 1},
      {"iou_g": 0.5, "recall_o": 1, "missed": 0, "false": 1}])"));
  EXPECT_TRUE(json::parse(get("/found/1").body).at("scores").empty());
}

TEST_F(Page, ComparesNothingByItself) {
  EXPECT_EQ(figures().at("compared"), nullptr);
}

class ComparedCapture : public EightFrames {
 protected:
  void play(const std::filesystem::path& truth, const MethodOptions* beside = nullptr) {
    capture_ = LabelledCapture::open(options_, LabelledCapture::Makes::kPoints).value();
    auto labels =
        beside == nullptr ? nullptr : CaptureLabels::open(*capture_, options_, *beside).value();
    played_ = std::make_unique<PlayedCapture>(*capture_, options_, FrameTruth::open(truth).value(),
                                              std::move(labels));
  }
  [[nodiscard]] Status next() { return played_->next() ? played_->take(frame_) : Status(); }

  std::unique_ptr<LabelledCapture> capture_;
  std::unique_ptr<PlayedCapture> played_;
  PlayedFrame frame_;
};

TEST_F(ComparedCapture, HasTheTruthOfEachFrame) {
  play(drive::truth_folder_of(options_.capture.file));
  for (int number = 0; number < 8; ++number) {
    ASSERT_TRUE(next());
    ASSERT_TRUE(frame_.comparison.quality) << number;
    EXPECT_GT(frame_.comparison.quality->iou_ground(), 0.95);
  }
  ASSERT_TRUE(played_->go_to(0.5));
  for (int frames = 0; frames < 2; ++frames) ASSERT_TRUE(next());
  EXPECT_TRUE(frame_.comparison.quality) << "the first frame after a seek is cut off";
}

TEST_F(ComparedCapture, RefusesTheTruthOfAnother) {
  const auto truth = folder_ / "other";
  std::filesystem::create_directory(truth);
  std::ofstream(truth / "000000.label") << "8 bytes!";
  play(truth);
  const Status taken = next();
  ASSERT_FALSE(taken);
  EXPECT_EQ(taken.error().code, ErrorCode::kMalformed);
  EXPECT_THAT(taken.error().message, HasSubstr("000000.label"));
}

TEST_F(ComparedCapture, ShowsFramesThatHaveNoTruthWithoutIt) {
  const auto truth = drive::truth_folder_of(options_.capture.file);
  std::filesystem::remove(truth / "000001.label");
  std::ofstream(truth / "000002.label") << "8 bytes!";
  play(truth);
  for (const bool has_truth : {true, false, false, true}) {
    ASSERT_TRUE(next());
    EXPECT_EQ(frame_.comparison.quality.has_value(), has_truth);
  }
}

TEST_F(ComparedCapture, HasTheLabelsThatTheOtherMethodGivesAlone) {
  MethodOptions paper;
  paper.profile = Profile::kPaper;  // which hands over a frame after other packets
  std::map<std::uint32_t, std::vector<Label>> by_paper;
  for (const bool is_paper_beside : {true, false}) {
    SCOPED_TRACE(is_paper_beside);
    Options other = options_;
    (is_paper_beside ? other : options_).method = paper;
    auto alone = LabelledCapture::open(other, LabelledCapture::Makes::kLabels).value();
    std::map<std::uint32_t, std::vector<Label>> labels;
    while (const run::Frame* frame = alone->next()) {
      labels[frame->record.info.number].assign(alone->labels().begin(), alone->labels().end());
    }
    play({}, &other.method);
    const auto expect_same = [&] {
      const std::vector<Label>& expected = labels[frame_.record.info.number];
      ASSERT_EQ(frame_.comparison.of_returns.size(), expected.size());
      std::size_t same = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        same += static_cast<Label>(frame_.comparison.of_returns[i] >> 2U) == expected[i] ? 1 : 0;
      }
      EXPECT_EQ(same, expected.size()) << frame_.record.info.number;
      EXPECT_GT(frame_.comparison.differing, 0U);
    };
    for (int number = 0; number < 8; ++number) {
      ASSERT_TRUE(next());
      expect_same();
    }
    ASSERT_TRUE(played_->go_to(0));
    ASSERT_TRUE(next());
    expect_same();
    ASSERT_TRUE(played_->go_to(0.5));
    for (int frames = 0; frames < 2; ++frames) ASSERT_TRUE(next());
    EXPECT_EQ(frame_.comparison.of_returns.size(), frame_.points.size());
  }
}

TEST_F(ComparedCapture, OfCloudsHasBothToo) {
  const auto clouds = folder_ / "clouds", truth = folder_ / "truth";
  for (const auto& folder : {clouds, truth}) std::filesystem::create_directory(folder);
  play({});
  while (played_->next()) {
    ASSERT_TRUE(played_->take(frame_));
    const std::uint32_t number = frame_.record.info.number;
    write_cloud(clouds / fmt::format("{:06}.pcd", 10 + number), frame_);
    std::filesystem::copy(
        drive::truth_folder_of(options_.capture.file) / fmt::format("{:06}.label", number),
        truth / fmt::format("{:06}.label", 10 + number));
  }
  MethodOptions paper;
  paper.profile = Profile::kPaper;
  const auto played =
      PlayedClouds::open(clouds, options_, FrameTruth::open(truth).value(), &paper).value();
  EXPECT_TRUE(played->has_truth());
  ASSERT_TRUE(played->next());
  ASSERT_TRUE(played->take(frame_));
  const FrameComparison& comparison = frame_.comparison;
  ASSERT_TRUE(comparison.quality && comparison.quality_beside);
  EXPECT_GT(comparison.quality->iou_ground(), 0.9);
  EXPECT_GT(comparison.quality_beside->iou_ground(), 0.8);
  EXPECT_EQ(comparison.of_returns.size(), frame_.points.size());
  EXPECT_GT(comparison.differing, 0U);
  std::filesystem::resize_file(truth / "000010.label", 8);
  const auto other =
      PlayedClouds::open(clouds, options_, FrameTruth::open(truth).value(), nullptr).value();
  ASSERT_TRUE(other->next());
  EXPECT_FALSE(other->take(frame_)) << "it is the truth of others";
}

}  // namespace
}  // namespace terracut::cli
