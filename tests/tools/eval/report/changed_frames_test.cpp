// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/eval/report/changed_frames.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/firmware_io/scan/scratch_folder.hpp"
#include "tests/tools/eval/made_up_dataset.hpp"
#include "tools/eval/evaluation.hpp"
#include "tools/eval/simulated_evaluation.hpp"

namespace terracut::evaluation::report {
namespace {

namespace fs = std::filesystem;
using pipeline::Label;

/// Four returns around the sensor: road, car, road, of no class.
class ChangedFramesTest : public testing::Test {
 protected:
  ChangedFramesTest() {
    for (int i = 0; i < 4; ++i) {
      pipeline::Return echo;
      echo.x_m = static_cast<float>(5 + i);
      echo.ground_range_m = echo.x_m;
      image_.place(0, i, echo);
    }
  }
  void look(const std::string& frame, const std::vector<Label>& first,
            const std::vector<Label>& other) {
    static const std::string kSequence = "00";
    changed_.look({kSequence, frame, image_, classes_,
                   [&](std::size_t i) { return std::span(i == 0 ? first : other); }});
  }
  [[nodiscard]] nlohmann::json written() const {
    const Status status = changed_.write(folder_.path());
    EXPECT_TRUE(status) << status.error().message;
    std::ifstream file(folder_.path() / "changes.json");
    return nlohmann::json::parse(file);
  }

  static constexpr Label kG = Label::kGround, kO = Label::kObstacle;
  firmware_io::ScratchFolder folder_;
  rt::FixedMemory memory_;
  pipeline::RangeImage image_{{.rows = 2, .columns = 8}, 0, memory_};
  std::vector<std::uint16_t> classes_{40, 10, 40, 0};
  ClassTable table_ = *ClassTable::parse(kSemanticKittiClasses, "built-in");
  std::vector<MethodChoice> methods_{*method_named("terracut"), *method_named("paper")};
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
  methods_.push_back(*method_variant("blind=terracut,elevation_map.obstacle_height_m=2", {}));
  methods_.push_back(*method_variant("same=terracut", {}));
  ChangedFrames of_scans(methods_, table_), of_drive(methods_, table_);
  EvaluationConfig scans;
  scans.root = dataset.root();
  scans.methods = methods_;
  scans.jobs = 2;
  scans.changed_frames = &of_scans;
  ASSERT_TRUE(evaluate(scans, nullptr, [](std::size_t, std::size_t) {}, [] { return false; }));
  SimulatedConfig drive;
  drive.drives = {.scenes = {"street"}, .duration_s = 0.1};
  drive.methods = methods_;
  drive.changed_frames = &of_drive;
  ASSERT_TRUE(evaluate_simulated(drive, nullptr,
                                 {[](double, double) {}, [](std::size_t, std::size_t) {}},
                                 [] { return false; }));
  for (const ChangedFrames* const changed : {&of_scans, &of_drive}) {
    const firmware_io::ScratchFolder folder;
    ASSERT_TRUE(changed->write(folder.path()));
    EXPECT_TRUE(fs::exists(folder.path() / "blind.png"));
    EXPECT_FALSE(fs::exists(folder.path() / "terracut.png"));
    EXPECT_FALSE(fs::exists(folder.path() / "same.png"));
  }
}

}  // namespace
}  // namespace terracut::evaluation::report
