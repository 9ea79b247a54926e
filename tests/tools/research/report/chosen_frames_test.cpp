// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/report/chosen_frames.hpp"

#include <gmock/gmock.h>

namespace terracut::report {
namespace {

using testing::ElementsAre;

Json frame(const char* sequence, const char* name, Json recall_o, double iou_g) {
  return {
      {"sequence", sequence}, {"frame", name}, {"recall_o", std::move(recall_o)}, {"iou_g", iou_g}};
}

Json method_of(std::vector<Json> frames) {
  return {{"frames", std::move(frames)}};
}

std::vector<std::string> named(const std::vector<ChosenFrame>& frames) {
  std::vector<std::string> names;
  for (const ChosenFrame& chosen : frames) {
    names.push_back(chosen.sequence + "/" + chosen.frame + " " + chosen.why);
  }
  return names;
}

TEST(ChosenFrames, AreTheWorstOfEverySequence) {
  const Json method = method_of({frame("00", "a", 0.9, 0.8), frame("00", "b", 0.7, 0.9),
                                 frame("00", "c", nullptr, 0.5), frame("03", "d", 0.2, 0.2)});
  EXPECT_THAT(named(worst_frames(method)), ElementsAre("00/b lowest Recall_o", "00/c lowest IoU_g",
                                                       "03/d lowest Recall_o and lowest IoU_g"));
}

TEST(ChosenFrames, HaveNoWorstRecallWhereThereIsNone) {
  const Json method = method_of({frame("00", "a", nullptr, 0.8)});
  EXPECT_THAT(named(worst_frames(method)), ElementsAre("00/a lowest IoU_g"));
}

TEST(ChosenFrames, AreTheMiddleOfEverySequence) {
  const Json method = method_of({frame("00", "a", 1, 1), frame("00", "b", 1, 1),
                                 frame("00", "c", 1, 1), frame("03", "d", 1, 1)});
  EXPECT_THAT(named(middle_frames(method)), ElementsAre("00/b middle", "03/d middle"));
}

TEST(ChosenFrames, AreThoseOfTheDefaultProfileWhereItWasMeasured) {
  EXPECT_EQ(method_in_question({{"methods", {{"pfaff", 1}, {"terracut", 1}}}}), "terracut");
  EXPECT_EQ(method_in_question({{"methods", {{"zhang", 1}, {"pfaff", 1}}}}), "zhang");
}

}  // namespace
}  // namespace terracut::report
