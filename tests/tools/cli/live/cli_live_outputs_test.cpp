// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What becomes of a live run whose outputs cannot be had: it labels, and tries again.
#include "tests/tools/cli/live/cli_live.hpp"

namespace terracut::cli {
namespace {

using testing::HasSubstr;

class CliLiveOutputs : public CliLive {};

TEST_F(CliLiveOutputs, LabelsAreWrittenAgainWhenTheirFolderIsBack) {
  LiveRun run = live_with_table("--labels labels --json live.json");
  const Sensors sender = sensor(run);
  const auto unwritten = [](const auto& figures) {
    return LiveRun::loss(figures, "unwritten_label_frames");
  };
  EXPECT_TRUE(labels(run, 1));
  // What is to be their folder is a file: nobody may write there, whoever they are.
  fs::rename(folder_ / "labels", folder_ / "taken away");
  write("labels", "a file");
  EXPECT_TRUE(run.says("no labels are written, which is tried again every second"));
  EXPECT_TRUE(run.shows([&](const auto& figures) { return unwritten(figures) > 0; }));
  fs::remove(folder_ / "labels");
  fs::rename(folder_ / "taken away", folder_ / "labels");
  EXPECT_TRUE(run.says("labels are written again"));
  const Outcome outcome = run.interrupted();
  EXPECT_EQ(outcome.exit_code, kOutputFailed) << "frames are missing";
}

}  // namespace
}  // namespace terracut::cli
