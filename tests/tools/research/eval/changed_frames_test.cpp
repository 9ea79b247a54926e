// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/eval/changed_frames.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/scratch_folder.hpp"
#include "tests/tools/research/eval/made_up_dataset.hpp"
#include "tools/research/datasets/built_in_tables.hpp"
#include "tools/research/eval/evaluation.hpp"
#include "tools/research/eval/simulated_evaluation.hpp"

namespace terracut::eval {
namespace {

namespace fs = std::filesystem;
using frame::Label;

/// Four returns around the sensor: road, car, road, of no class.
class ChangedFramesTest : public testing::Test {
 protected:
  ChangedFramesTest() {
    for (int i = 0; i < 4; ++i) {
      frame::Return point;
      point.x_m = static_cast<float>(5 + i);
      point.ground_range_m = point.x_m;
      image_.place(0, i, point);
    }
  }
  void look(const std::string& frame, const std::vector<Label>& first,
            const std::vector<Label>& other) {
    static const std::string kSequence = "00";
    static const mount::RingProfile kProfile;
    changed_.look({kSequence,
                   frame,
                   image_,
                   kProfile,
                   truth_,
                   [&](std::size_t i) { return std::span(i == 0 ? first : other); },
                   {}});
  }
  [[nodiscard]] nlohmann::json written() const {
    const Status status = changed_.write(folder_.path());
    EXPECT_TRUE(status) << status.error().message;
    std::ifstream file(folder_.path() / "changes.json");
    return nlohmann::json::parse(file);
  }

  static constexpr Label kG = Label::kGround, kO = Label::kObstacle;
  test::ScratchFolder folder_;
  memory::FixedMemory memory_;
  frame::RangeImage image_{{.rows = 2, .columns = 8}, 0, memory_};
  std::vector<std::uint32_t> truth_{40, 10, 40, 0};
  datasets::ClassTable table_ = *datasets::built_in_table("semantickitti");
  std::vector<MethodChoice> methods_{*eval::method_named("terracut"), *eval::method_named("paper")};
  ChangedFrames changed_{methods_, table_};
};

TEST_F(ChangedFramesTest, CountWhatTheFirstMethodHasRightAndWrong) {
  look("000001", {kG, kG, kG, kG}, {kO, kO, kG, kO});
  const auto change = written().at("paper");
  EXPECT_EQ(change.at("returns"), 3);
  EXPECT_EQ(change.at("right"), 1);
  EXPECT_EQ(change.at("wrong"), 1);
}

TEST_F(ChangedFramesTest, KeepTheFrameThatChangedMostAndOfEqualOnesTheFirst) {
  look("000003", {kG, kO, kG, kG}, {kO, kG, kG, kG});
  look("000001", {kG, kO, kG, kG}, {kO, kO, kG, kG});
  look("000002", {kG, kO, kG, kG}, {kG, kG, kO, kG});
  EXPECT_EQ(written().at("paper").at("frame"), "000002");
}

TEST_F(ChangedFramesTest, OtherGroundIsGround) {
  look("000001", {kG, kO, kG, kG}, {Label::kOtherGround, kO, kG, kG});
  EXPECT_TRUE(written().empty());
  EXPECT_FALSE(fs::exists(folder_.path() / "paper.png"));
}

TEST_F(ChangedFramesTest, AreDrawnForEveryMethodOfADatasetAndOfADriveButTheFirst) {
  const MadeUpDataset dataset;
  methods_.push_back(*eval::method_variant("blind=terracut,elevation_map.obstacle_height_m=2", {}));
  methods_.push_back(*eval::method_variant("same=terracut", {}));
  ChangedFrames of_scans(methods_, table_), of_drive(methods_, table_);
  EvaluationConfig scans;
  scans.layout = table_.layout().value();
  scans.root = dataset.root();
  scans.methods = methods_;
  scans.jobs = 2;
  scans.on_labelled = [&](const LabelledByAll& frame) { of_scans.look(frame); };
  ASSERT_TRUE(
      eval::evaluate(scans, nullptr, [](std::size_t, std::size_t) {}, [] { return false; }));
  SimulatedConfig drive;
  drive.drives = {.scenes = {"street"}, .duration_s = 0.1};
  drive.methods = methods_;
  drive.on_labelled = [&](const LabelledByAll& frame) { of_drive.look(frame); };
  ASSERT_TRUE(eval::evaluate_simulated(drive, nullptr,
                                       {[](double, double) {}, [](std::size_t, std::size_t) {}},
                                       [] { return false; }));
  for (const ChangedFrames* const changed : {&of_scans, &of_drive}) {
    const test::ScratchFolder folder;
    ASSERT_TRUE(changed->write(folder.path()));
    EXPECT_TRUE(fs::exists(folder.path() / "blind.png"));
    EXPECT_FALSE(fs::exists(folder.path() / "terracut.png"));
    EXPECT_FALSE(fs::exists(folder.path() / "same.png"));
  }
}

}  // namespace
}  // namespace terracut::eval
