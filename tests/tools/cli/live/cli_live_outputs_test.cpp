// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What becomes of a live run whose outputs cannot be had: it labels, and tries again.
#include <fcntl.h>

#include <csignal>
#include <cstdio>
#include <optional>
#include <stdexcept>

#include "pipeline/stream/listening_socket.hpp"
#include "tests/tools/cli/live/cli_live.hpp"

namespace terracut::cli {
namespace {

using testing::HasSubstr;

class CliLiveOutputs : public CliLive {};

/// Exchanges two paths at once: the run makes its folder anew whenever it is not there.
void exchange(const fs::path& one, const fs::path& other) {
  ASSERT_EQ(::renameat2(AT_FDCWD, one.c_str(), AT_FDCWD, other.c_str(), RENAME_EXCHANGE), 0);
}

TEST_F(CliLiveOutputs, LabelsAreWrittenAgainWhenTheirFolderIsBack) {
  LiveRun run = live_with_table("--labels labels --json live.json");
  const Sensors sender = sensor(run);
  const auto unwritten = [](const auto& figures) {
    return LiveRun::loss(figures, "unwritten_label_frames");
  };
  EXPECT_TRUE(labels(run, 1));
  // What is to be their folder is a file: nobody may write there, whoever they are.
  write("exchanged", "a file");
  exchange(folder_ / "labels", folder_ / "exchanged");
  EXPECT_TRUE(run.says("no labels are written, which is tried again every second"));
  EXPECT_TRUE(run.shows([&](const auto& figures) { return unwritten(figures) > 0; }));
  exchange(folder_ / "labels", folder_ / "exchanged");
  EXPECT_TRUE(run.says("labels are written again"));
  const Outcome outcome = run.interrupted();
  EXPECT_EQ(outcome.exit_code, kOutputFailed) << "frames are missing";
}

/// A port of this machine that the test has, so that nobody else gets it.
class TakenPort {
 public:
  TakenPort() {
    auto socket = stream::ListeningSocket::open({});
    if (!socket) throw std::runtime_error(socket.error().message);
    socket_.emplace(*std::move(socket));
  }
  [[nodiscard]] std::string text() const { return to_string(socket_->address()); }
  void give_back() { socket_.reset(); }

 private:
  std::optional<stream::ListeningSocket> socket_;
};

TEST_F(CliLiveOutputs, WhosePortsAreTakenKeepNoRunFromLabelling) {
  const TakenPort view, foxglove, metrics, stream;
  LiveRun run =
      live_with_table("--view " + view.text() + " --foxglove " + foxglove.text() + " --metrics " +
                      metrics.text() + " --stream " + stream.text() + " --stream-sectors");
  const Sensors sender = sensor(run);
  EXPECT_TRUE(labels(run, 3));
  for (const char* what : {"no /metrics", "no frames for view", "no frames for foxglove",
                           "no stream of labelled points"}) {
    EXPECT_TRUE(run.says("warning: " + std::string(what) + ", which is tried again every 10 s: "));
  }
  for (const char* loss : {"view_frames_while_closed", "foxglove_frames_while_closed",
                           "stream_frames_while_closed", "stream_sectors_while_closed"}) {
    EXPECT_TRUE(run.shows([=](const auto& figures) { return LiveRun::loss(figures, loss) > 0; }));
  }
  expect_good_end(run.interrupted());
}

TEST_F(CliLiveOutputs, AreThereAsSoonAsTheirPortIsFree) {
  TakenPort stream;
  LiveRun run = live_with_table("--stream " + stream.text());
  const Sensors sender = sensor(run);
  EXPECT_TRUE(run.says("no stream of labelled points"));
  stream.give_back();
  EXPECT_TRUE(run.says("stream of labelled points again"));
  expect_good_end(run.interrupted());
}

TEST_F(CliLiveOutputs, ThatCannotBeWrittenKeepNoRunFromLabelling) {
  write("file", "a file, where folders are to be");
  LiveRun run =
      live_with_table("--mcap file/bag --labels file --recorder-folder file --json live.json");
  const Sensors sender = sensor(run);
  EXPECT_TRUE(labels(run, 3));
  for (const char* what : {"--labels file is to be a folder", "no dumps", "no frames for mcap",
                           "no labels are written"}) {
    EXPECT_TRUE(run.says(what)) << what;
  }
  EXPECT_TRUE(run.shows([](const auto& figures) {
    return LiveRun::loss(figures, "mcap_frames_while_closed") > 0 &&
           LiveRun::loss(figures, "unwritten_label_frames") > 0;
  }));
  const Outcome outcome = run.interrupted();
  EXPECT_EQ(outcome.exit_code, kOutputFailed) << "recordings are missing";
  EXPECT_GE(json("live.json")["frames"]["count"], 3);
}

TEST_F(CliLiveOutputs, ARecordingOfARunThatWasKilledIsKeptByTheNext) {
  {
    LiveRun killed = live_with_table("--mcap bag");
    const Sensors sender = sensor(killed);
    EXPECT_TRUE(killed.says("recording to bag"));
    EXPECT_TRUE(labels(killed, 3));
    killed.interrupt(SIGKILL);
  }
  const std::size_t left = files_in(folder_ / "bag", "");
  LiveRun run = live_with_table("--mcap bag");
  const Sensors sender = sensor(run);
  EXPECT_TRUE(run.says("recording to bag_2"));
  EXPECT_TRUE(labels(run, 3));
  expect_good_end(run.interrupted());
  EXPECT_TRUE(fs::exists(folder_ / "bag_2/bag_2_0.mcap"));
  EXPECT_EQ(files_in(folder_ / "bag", ""), left);
}

TEST_F(CliLiveOutputs, ThatCanNeverBeAreRefusedBeforeTheSensorIsWaitedFor) {
  const Outcome outcome = run("live --mcap x.mcap --mcap-split-s 1 --metrics off");
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_THAT(outcome.err, HasSubstr("expected a folder, for one that is split"));
}

}  // namespace
}  // namespace terracut::cli
