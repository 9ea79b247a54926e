// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// tools/examples/read_frames.py, a second reader of the format, written without this one's code.
#include <gmock/gmock.h>

#include <cstdio>
#include <cstdlib>
#include <future>

#include "stream_test_support.hpp"
#include "tests/support/places.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::stream {
namespace {

class ReadFramesScript : public StreamTest {
 protected:
  struct Outcome {
    int status = -1;
    std::string text;  ///< Both of its outputs.
  };

  void SetUp() override {
    if (std::system("python3 -c 'import sys; sys.exit(sys.version_info < (3, 8))' 2>/dev/null") !=
        0)
      GTEST_SKIP() << "no python3 of version 3.8 or newer";
    StreamTest::SetUp();
    open({.max_points = 200'000, .serves_sectors = true});
  }
  void TearDown() override {
    if (!folder_.empty()) StreamTest::TearDown();
  }
  [[nodiscard]] std::future<Outcome> run(const std::string& arguments) const {
    return run_at(to_string(server_->address()), arguments);
  }
  [[nodiscard]] static std::future<Outcome> run_at(const std::string& address,
                                                   const std::string& arguments) {
    const std::string command = "python3 " +
                                (test::source_folder() / "tools/examples/read_frames.py").string() +
                                " " + address + " " + arguments + " 2>&1";
    return std::async(std::launch::async, [command] {
      Outcome outcome;
      std::FILE* pipe = ::popen(command.c_str(), "re");
      char buffer[1024];
      while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) outcome.text += buffer;
      outcome.status = ::pclose(pipe);
      return outcome;
    });
  }
  [[nodiscard]] bool reader_came() {
    return step_until([this] { step(); }, [this] { return figures().connected == 1; });
  }
  [[nodiscard]] Outcome end_of(std::future<Outcome>& script) {
    while (script.wait_for(std::chrono::seconds(0)) != std::future_status::ready) step();
    return script.get();
  }
};

TEST_P(ReadFramesScript, PrintsWhatWasServed) {
  auto script = run("--count 1");
  ASSERT_TRUE(reader_came());
  const auto points = points_of_frame(41, 150'000);
  status::FrameRecord record = record_of(41);
  record.level = status::Level::kCutStopped;
  ASSERT_TRUE(server().serve(frame_of(record, points, true)));
  const Outcome outcome = end_of(script);
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.text,
            "frame 41  hdl64e  cut_stopped  150000 points  50000 ground  100000 obstacle  labelled "
            "after 6.0 ms  late\n");
}

TEST_P(ReadFramesScript, SaysOfASectorWhereInItsFrameItIs) {
  auto script = run("--sectors --count 1 --pcd " + folder_.string());
  ASSERT_TRUE(reader_came());
  const auto points = points_of_frame(41, 1500);
  const points::SectorRecord sector{.frame = 41,
                                    .first_return = 3000,
                                    .first_packet_ns = 1'000'000'000,
                                    .last_packet_ns = 1'001'000'000,
                                    .labels_ns = 1'018'000'000};
  const LabelledFrame given{header_of(sector, sensor::SensorModel::kHdl64e, false, points.size()),
                            points};
  // It gets none until its question has been heard.
  ASSERT_TRUE(step_until([&] { (void)server().serve(given); }, [&] { return figures().sent > 0; }));
  const Outcome outcome = end_of(script);
  EXPECT_EQ(outcome.text,
            "frame 41 from return 3000  hdl64e  1500 points  500 ground  1000 obstacle  labelled "
            "after 17.0 ms\n");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "000041-003000.pcd"));
}

TEST_P(ReadFramesScript, WritesPcdFilesWithThePointsAsTheyWere) {
  auto script = run("--count 1 --pcd " + folder_.string());
  ASSERT_TRUE(reader_came());
  const auto points = points_of_frame(3, 1000);
  ASSERT_TRUE(server().serve(frame_of(3, points)));
  const Outcome outcome = end_of(script);
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  const std::string content = test::content_of(folder_ / "000003.pcd");
  const auto wire = on_wire(points);
  const std::string_view bytes(reinterpret_cast<const char*>(wire.data()),
                               wire.size() * sizeof(WirePoint));
  EXPECT_THAT(content, testing::HasSubstr("\nSIZE 4 4 4 1 1 2 4\n"));
  ASSERT_GT(content.size(), bytes.size());
  EXPECT_EQ(content.substr(content.size() - bytes.size()), bytes);
}

TEST_P(ReadFramesScript, WritesTheHeightsOfPointsThatHaveThem) {
  server_.reset();
  open({.max_points = 1000, .has_heights = true});
  auto script = run("--count 1 --pcd " + folder_.string());
  ASSERT_TRUE(reader_came());
  const auto points = points_of_frame(3, 1000);
  const std::vector<float> heights_m(points.size(), 1.25F);
  LabelledFrame given = frame_of(3, points);
  given.heights_m = heights_m;
  ASSERT_TRUE(server().serve(given));
  const Outcome outcome = end_of(script);
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_THAT(outcome.text, testing::HasSubstr("1000 points  334 ground  666 obstacle"));
  const std::string content = test::content_of(folder_ / "000003.pcd");
  EXPECT_THAT(content,
              testing::HasSubstr(" ring time height_above_ground\nSIZE 4 4 4 1 1 2 4 4\n"));
  const std::string_view last(reinterpret_cast<const char*>(heights_m.data()), sizeof(float));
  EXPECT_THAT(content, testing::EndsWith(std::string(last)));
}

TEST_P(ReadFramesScript, WritesTheObjectsOfPointsThatHaveThem) {
  server_.reset();
  open({.max_points = 1000, .has_objects = true});
  auto script = run("--count 1 --pcd " + folder_.string());
  ASSERT_TRUE(reader_came());
  const auto points = points_of_frame(3, 1000);
  const std::vector<std::uint16_t> objects(points.size(), 0x102);
  LabelledFrame given = frame_of(3, points);
  given.objects = objects;
  ASSERT_TRUE(server().serve(given));
  const Outcome outcome = end_of(script);
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  const std::string content = test::content_of(folder_ / "000003.pcd");
  EXPECT_THAT(content, testing::HasSubstr(" time height_above_ground object\n"
                                          "SIZE 4 4 4 1 1 2 4 4 4\nTYPE F F F U U U F F U\n"));
  EXPECT_THAT(content, testing::EndsWith(std::string("\x02\x01\0\0", 4)));
}

TEST_P(ReadFramesScript, EndsWithoutComplaintWhenTheServerEnds) {
  auto script = run("");
  ASSERT_TRUE(reader_came());
  ASSERT_TRUE(server().serve(frame_of(0, {})));
  server_.reset();
  const Outcome outcome = script.get();
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_THAT(outcome.text, testing::HasSubstr("0 points"));
}

TEST_P(ReadFramesScript, SaysWhereNobodyServes) {
  const std::string address = to_string(server().address());
  server_.reset();
  const Outcome outcome = run_at(address, "").get();
  EXPECT_NE(outcome.status, 0);
  EXPECT_THAT(outcome.text, testing::StartsWith("read_frames: " + address + ": "));
  EXPECT_THAT(outcome.text, testing::Not(testing::HasSubstr("Traceback")));
}

INSTANTIATE_TEST_SUITE_P(Over, ReadFramesScript, testing::Values(Transport::kTcp, Transport::kUnix),
                         transport_name);

}  // namespace
}  // namespace terracut::stream
