// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What is written, as far as it can be seen without a reader; that readers which share no code with
// it read every message is tests/tools/cli/mcap/read_mcap.mjs.
#include "pipeline/mcap/mcap_sink.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <string>

#include "tests/support/scratch_folder.hpp"
#include "tests/support/small_disk.hpp"

namespace terracut::mcap {
namespace {

namespace fs = std::filesystem;

using test::content_of;

constexpr int kFooter = 2, kChunk = 6, kStatistics = 11;

/// How many records of each kind a file has, from its magic on, as long as they are whole.
struct Records {
  std::map<int, int> of;
  std::string statistics;   ///< The content of the last record of them.
  bool ends_whole = false;  ///< Behind the last one comes nothing, or the magic.
};
Records records_of(const fs::path& path) {
  const std::string content = content_of(path);
  const std::string magic("\x89MCAP0\r\n", 8);
  Records records;
  EXPECT_EQ(content.substr(0, 8), magic) << path;
  std::size_t at = 8;
  while (at + 9 <= content.size() && content.substr(at) != magic) {
    std::uint64_t length = 0;
    std::memcpy(&length, content.data() + at + 1, sizeof length);
    if (length > content.size() - at - 9) return records;
    ++records.of[static_cast<unsigned char>(content[at])];
    if (content[at] == kStatistics) records.statistics = content.substr(at + 9, length);
    at += 9 + length;
  }
  records.ends_whole = at == content.size() || content.substr(at) == magic;
  return records;
}

class McapSinkTest : public test::InScratchFolder {
 protected:
  std::unique_ptr<McapSink> open(McapSink::Config config) {
    auto sink = McapSink::open(std::move(config), {.sensor = "a sensor"});
    EXPECT_TRUE(sink) << sink.error().message;
    return *std::move(sink);
  }
  /// Frames of `points`, ten a second, from `first` on.
  static void put_frames(McapSink& sink, int first, int count, std::size_t points) {
    for (int n = first; n < first + count; ++n) {
      publish::LabelledFrame frame;
      frame.record.info.number = static_cast<std::uint32_t>(n);
      frame.record.info.first_packet_ns = 1'000'000'000'000 + n * 100'000'000LL;
      frame.record.info.last_packet_ns = frame.record.info.first_packet_ns + 100'000'000;
      frame.points.resize(points);
      for (std::size_t i = 0; i < points; ++i) {
        frame.points[i].x_m = static_cast<float>(i) * 0.37F;
        frame.points[i].label = i % 3 == 0 ? frame::Label::kObstacle : frame::Label::kGround;
      }
      ASSERT_TRUE(sink.put(frame));
    }
  }
  std::set<std::string> names_in(const fs::path& folder) const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }
};

TEST_F(McapSinkTest, AFileIsWholeWhenItHasItsName) {
  const auto sink = open({.path = folder_ / "drive.mcap"});
  put_frames(*sink, 0, 3, 50'000);
  EXPECT_FALSE(fs::exists(folder_ / "drive.mcap"));
  ASSERT_TRUE(sink->finish());
  EXPECT_EQ(names_in(folder_), (std::set<std::string>{"drive.mcap"}));
  const Records records = records_of(folder_ / "drive.mcap");
  EXPECT_TRUE(records.ends_whole);
  EXPECT_EQ(records.of.at(kFooter), 1);
  EXPECT_EQ(records.of.at(kStatistics), 1);
  // Eight fields, the length of the table of counts, and a channel's number and count for each.
  std::uint32_t channels = 0;
  ASSERT_GE(records.statistics.size(), 10 + sizeof channels);
  std::memcpy(&channels, records.statistics.data() + 10, sizeof channels);
  EXPECT_EQ(records.statistics.size(), 42 + 4 + channels * (2 + 8));
}

TEST_F(McapSinkTest, OneThatIsNotFinishedIsOnTheDiskUpToTheFrameInWork) {
  const auto sink = open({.path = folder_ / "drive.mcap"});
  put_frames(*sink, 0, 5, 50'000);
  const auto names = names_in(folder_);  // as a process that is killed here leaves it
  ASSERT_EQ(names.size(), 1U);
  EXPECT_THAT(*names.begin(), testing::StartsWith("drive.mcap.part-"));
  const Records records = records_of(folder_ / *names.begin());
  EXPECT_TRUE(records.ends_whole) << "no chunk is in pieces";
  EXPECT_GE(records.of.at(kChunk), 5);
  EXPECT_EQ(records.of.count(kFooter), 0U);
  ASSERT_TRUE(sink->finish());
}

TEST_F(McapSinkTest, ABagIsSplitBySizeAndByTimeAndLosesNothingInBetween) {
  const auto by_size = open({.path = folder_ / "size", .split_bytes = 1'000'000});
  put_frames(*by_size, 0, 20, 20'000);
  ASSERT_TRUE(by_size->finish());
  const auto names = names_in(folder_ / "size");
  EXPECT_GT(names.size(), 3U);
  EXPECT_TRUE(names.contains("size_0.mcap") && names.contains("size_1.mcap") &&
              names.contains("metadata.yaml"));
  for (const std::string& name : names) {
    if (name != "metadata.yaml") {
      EXPECT_EQ(records_of(folder_ / "size" / name).of.at(kFooter), 1);
    }
  }

  const auto by_time = open({.path = folder_ / "time", .split_ns = 500'000'000});
  put_frames(*by_time, 0, 12, 10);
  ASSERT_TRUE(by_time->finish());
  EXPECT_EQ(names_in(folder_ / "time"),
            (std::set<std::string>{"metadata.yaml", "time_0.mcap", "time_1.mcap", "time_2.mcap"}));
  const std::string metadata = content_of(folder_ / "time/metadata.yaml");
  EXPECT_THAT(metadata, testing::HasSubstr("name: /terracut/points\n        type: "
                                           "sensor_msgs/msg/PointCloud2\n"));
  EXPECT_THAT(metadata, testing::HasSubstr("message_count: 12\n")) << "of a topic";
  EXPECT_THAT(metadata, testing::HasSubstr("  message_count: 39\n"))
      << "three clouds a frame, and a transform a file";
  EXPECT_THAT(metadata, testing::HasSubstr("path: \"time_2.mcap\""));
  EXPECT_THAT(metadata, testing::HasSubstr("nanoseconds: 1100000000\n"));
}

TEST_F(McapSinkTest, RefusesWhatCannotBe) {
  const auto refusal = [&](McapSink::Config config) {
    const auto sink = McapSink::open(std::move(config), {});
    return sink ? std::string() : sink.error().message;
  };
  EXPECT_THAT(refusal({.path = folder_ / "a.mcap", .split_bytes = 1}),
              testing::HasSubstr("expected a folder"));
  fs::create_directory(folder_ / "full");
  std::ofstream(folder_ / "full/something") << "else";
  EXPECT_THAT(refusal({.path = folder_ / "full"}), testing::HasSubstr("there is something in it"));
  EXPECT_THAT(refusal({.path = folder_ / "nowhere/a.mcap"}), testing::HasSubstr("nowhere"));
}

TEST_F(McapSinkTest, OneThatNobodyWatchesOverNeverTakesTheOlderOnesPlace) {
  const auto record = [&](const fs::path& path) {
    const auto sink = open({.path = path, .unattended = true});
    put_frames(*sink, 0, 1, 10);
    EXPECT_TRUE(sink->finish());
    return sink->path();
  };
  EXPECT_EQ(record(folder_ / "drive.mcap"), folder_ / "drive.mcap");
  const std::string first = content_of(folder_ / "drive.mcap");
  EXPECT_EQ(record(folder_ / "drive.mcap"), folder_ / "drive_2.mcap");
  EXPECT_EQ(content_of(folder_ / "drive.mcap"), first);
  std::ofstream(folder_ / "drive_3.mcap.part-1-0") << "of a process that was killed";
  EXPECT_EQ(record(folder_ / "drive.mcap"), folder_ / "drive_4.mcap");

  EXPECT_EQ(record(folder_ / "bag/"), folder_ / "bag");
  EXPECT_EQ(record(folder_ / "bag"), folder_ / "bag_2");
  EXPECT_EQ(record(folder_ / "bag"), folder_ / "bag_3");
  EXPECT_EQ(names_in(folder_ / "bag_3"), (std::set<std::string>{"bag_3_0.mcap", "metadata.yaml"}));
  fs::create_directory(folder_ / "empty");
  EXPECT_EQ(record(folder_ / "empty"), folder_ / "empty") << "nothing is in the way";
  std::ofstream(folder_ / "file") << "something else";
  EXPECT_EQ(record(folder_ / "file"), folder_ / "file_2");
}

TEST_F(McapSinkTest, OneThatNobodyWatchesOverLeavesRoomToOthersAndIsWhole) {
  const auto outcome = test::on_a_disk_of(4000, folder_, [&] {
    auto sink = McapSink::open({.path = folder_ / "bag", .unattended = true}, {});
    if (!sink) return test::InChild::kOtherwise;
    publish::LabelledFrame frame;
    frame.points.resize(20'000);
    for (std::size_t i = 0; i < frame.points.size(); ++i) {
      frame.points[i].x_m = static_cast<float>(i * 7919 % 104729) * 0.00937F;
    }
    Status put;
    for (int n = 0; n < 1000 && put; ++n) {
      frame.record.info.last_packet_ns = n * 100'000'000LL;
      put = (*sink)->put(frame);
    }
    const fs::space_info space = fs::space(folder_);
    const bool is_whole = fs::exists(folder_ / "bag/bag_0.mcap") &&
                          records_of(folder_ / "bag/bag_0.mcap").of.contains(kFooter) &&
                          fs::exists(folder_ / "bag/metadata.yaml");
    const bool leaves_room = !put && space.available > space.capacity / 50;
    const bool is_refused = !McapSink::open({.path = folder_ / "more", .unattended = true}, {});
    return is_whole && leaves_room && is_refused ? test::InChild::kAsExpected
                                                 : test::InChild::kOtherwise;
  });
  if (outcome == test::InChild::kNotPossible) GTEST_SKIP() << "no file system may be mounted here";
  EXPECT_EQ(outcome, test::InChild::kAsExpected);
}

TEST_F(McapSinkTest, MetadataNameFilesWithQuotesAndBackslashesAsYamlDoes) {
  const auto sink = open({.path = folder_ / "a\"b\\c"});
  put_frames(*sink, 0, 1, 10);
  ASSERT_TRUE(sink->finish());
  EXPECT_THAT(content_of(folder_ / "a\"b\\c/metadata.yaml"),
              testing::HasSubstr(R"("a\"b\\c_0.mcap")"));
}

TEST_F(McapSinkTest, FiguresAreDiagnostics) {
  const auto sink = open({.path = folder_ / "drive", .points_alone = true});
  put_frames(*sink, 0, 1, 10);
  const auto figures = std::make_unique<status::MonitorSnapshot>();
  figures->taken_ns = 1'000'200'000'000;
  ASSERT_TRUE(sink->put_figures(*figures));
  ASSERT_TRUE(sink->finish());
  EXPECT_THAT(content_of(folder_ / "drive/metadata.yaml"),
              testing::HasSubstr("type: diagnostic_msgs/msg/DiagnosticArray\n"));
  EXPECT_THAT(content_of(folder_ / "drive/metadata.yaml"),
              testing::HasSubstr("  message_count: 3\n"))
      << "points, diagnostics, transform";
}

}  // namespace
}  // namespace terracut::mcap
