// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/recorder/dump_folder.hpp"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <limits>
#include <set>
#include <stdexcept>

#include "tests/support/scratch_folder.hpp"

namespace terracut::test {
namespace {

namespace fs = std::filesystem;
using recorder::DumpFolder;
using recorder::DumpFolderLimits;
using recorder::DumpReason;
using recorder::DumpRefusal;
using testing::UnorderedElementsAre;

constexpr std::int64_t kSecond_ns = 1'000'000'000;
constexpr std::int64_t kStart_ns = 1'795'264'493'123 * (kSecond_ns / 1000);

class DumpFolderTest : public test::InScratchFolder {
 protected:
  [[nodiscard]] DumpFolderLimits limits() const {
    return {.folder = folder_, .least_free_bytes = 0};
  }
  void put(const std::string& name, std::size_t bytes = 1000) const {
    std::ofstream(folder_ / name) << std::string(bytes, 'x');
  }
  /// Room for a dump, and both its files, `age_s` after the start.
  void write_dump(DumpFolder& dumps, std::int64_t age_s, std::size_t bytes = 1000) const {
    const auto capture =
        dumps.make_room(bytes, DumpReason::kMissedDeadline, kStart_ns + age_s * kSecond_ns);
    ASSERT_TRUE(capture) << capture.error().message;
    std::ofstream(*capture) << std::string(bytes, 'p');
    std::ofstream(recorder::frame_times_path(*capture)) << "{}";
  }
  [[nodiscard]] std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }
  static DumpRefusal refusal_of(DumpFolder& dumps, std::uint64_t bytes) {
    const auto room = dumps.make_room(bytes, DumpReason::kAsked, kStart_ns);
    EXPECT_FALSE(room.has_value());
    EXPECT_FALSE(room.has_value() || room.error().message.empty());
    return room ? DumpRefusal::kTooSoon : room.error().refusal;
  }
  /// The number of a process that is no more.
  static ::pid_t dead_process() {
    const ::pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    ::waitpid(child, nullptr, 0);
    return child;
  }
};

TEST_F(DumpFolderTest, NamesADumpByNumberTimeAndReasonAndMakesTheFolder) {
  DumpFolderLimits deeper = limits();
  deeper.folder = folder_ / "a" / "b";
  DumpFolder dumps(deeper);
  const auto capture = dumps.make_room(1, DumpReason::kMissedDeadline, kStart_ns);
  ASSERT_TRUE(capture) << capture.error().message;
  EXPECT_EQ(*capture, deeper.folder / "terracut-000001-20261121T123453.123Z-missed_deadline.pcap");
  EXPECT_EQ(recorder::frame_times_path(*capture),
            deeper.folder / "terracut-000001-20261121T123453.123Z-missed_deadline.frames.json");
}

TEST_F(DumpFolderTest, NumbersDumpsOnWhatEverTheClockSays) {
  DumpFolder dumps(limits());
  for (const int age_s : {0, 0, -3600}) write_dump(dumps, age_s);
  EXPECT_THAT(files(), UnorderedElementsAre(
                           "terracut-000001-20261121T123453.123Z-missed_deadline.pcap",
                           "terracut-000001-20261121T123453.123Z-missed_deadline.frames.json",
                           "terracut-000002-20261121T123453.123Z-missed_deadline.pcap",
                           "terracut-000002-20261121T123453.123Z-missed_deadline.frames.json",
                           "terracut-000003-20261121T113453.123Z-missed_deadline.pcap",
                           "terracut-000003-20261121T113453.123Z-missed_deadline.frames.json"));
  DumpFolder of_the_next_run(limits());
  const auto capture = of_the_next_run.make_room(1, DumpReason::kAsked, kStart_ns);
  ASSERT_TRUE(capture);
  EXPECT_EQ(capture->filename(), "terracut-000004-20261121T123453.123Z-asked.pcap");
}

TEST_F(DumpFolderTest, GivesNoNumberTwiceThoughItsDumpIsGone) {
  DumpFolder dumps(limits());
  write_dump(dumps, 0);
  for (const std::string& name : files()) fs::remove(folder_ / name);
  const auto capture = dumps.make_room(1, DumpReason::kAsked, kStart_ns);
  ASSERT_TRUE(capture);
  EXPECT_EQ(capture->filename(), "terracut-000002-20261121T123453.123Z-asked.pcap");
}

TEST_F(DumpFolderTest, DeletesTheOldestDumpsBeyondTheirNumber) {
  DumpFolderLimits two = limits();
  two.most_dumps = 2;
  DumpFolder dumps(two);
  for (const int age_s : {0, 10, 20, 30}) write_dump(dumps, age_s);
  EXPECT_THAT(files(), UnorderedElementsAre(
                           "terracut-000003-20261121T123513.123Z-missed_deadline.pcap",
                           "terracut-000003-20261121T123513.123Z-missed_deadline.frames.json",
                           "terracut-000004-20261121T123523.123Z-missed_deadline.pcap",
                           "terracut-000004-20261121T123523.123Z-missed_deadline.frames.json"));
  EXPECT_EQ(dumps.deleted(), 2U);
}

TEST_F(DumpFolderTest, KeepsTheNewestDumpsAfterTheClockWasSetBack) {
  DumpFolderLimits two = limits();
  two.most_dumps = 2;
  DumpFolder dumps(two);
  for (const int age_s : {0, 10}) write_dump(dumps, age_s);
  for (const int age_s : {-86400, -86390}) write_dump(dumps, age_s);
  EXPECT_THAT(files(), testing::Each(testing::HasSubstr("-20261120T")));
  EXPECT_EQ(files().size(), 4U);
}

TEST_F(DumpFolderTest, DeletesDumpsOfEarlierVersionsFirst) {
  put("terracut-20991231T235959.999Z-asked.pcap");
  put("terracut-20991231T235959.999Z-asked.frames.json");
  DumpFolderLimits one = limits();
  one.most_dumps = 2;
  DumpFolder dumps(one);
  write_dump(dumps, 0);
  write_dump(dumps, 10);
  EXPECT_THAT(files(), testing::Each(testing::HasSubstr("-20261121T")));
}

TEST_F(DumpFolderTest, DeletesTheTableOfADumpWithIt) {
  DumpFolderLimits one = limits();
  one.most_dumps = 1;
  DumpFolder dumps(one);
  write_dump(dumps, 0);
  put("terracut-000001-20261121T123453.123Z-missed_deadline.calibration.xml");
  put("terracut-000001-20261121T123453.123Z-missed_deadline.calibration.txt");
  write_dump(dumps, 10);
  EXPECT_FALSE(
      files().contains("terracut-000001-20261121T123453.123Z-missed_deadline.calibration.xml"));
  EXPECT_TRUE(
      files().contains("terracut-000001-20261121T123453.123Z-missed_deadline.calibration.txt"));
}

TEST_F(DumpFolderTest, DeletesTheOldestDumpsBeyondTheirBytes) {
  DumpFolderLimits some = limits();
  some.most_bytes = 350'000;
  DumpFolder dumps(some);
  for (const int age_s : {0, 10, 20}) write_dump(dumps, age_s, 100'000);
  EXPECT_EQ(dumps.deleted(), 0U);
  write_dump(dumps, 30, 150'000);
  EXPECT_EQ(dumps.deleted(), 2U);
  EXPECT_EQ(files().size(), 4U);
}

TEST_F(DumpFolderTest, NeverTouchesOtherFiles) {
  const std::set<std::string> others{
      "drive.pcap",
      "terracut-notes.pcap",
      "terracut-20261121T115453.123Z-missed_deadline.pcap.bak",
      "terracut-20261121T115453.123Z-interesting.pcap",
      "terracut-20261121T115453.123Z.pcap",
      "terracut-2026112XT115453.123Z-asked.pcap",
      "terracut-000000-20261121T115453.123Z-asked.pcap",
      "terracut-0x1-20261121T115453.123Z-asked.pcap",
      "terracut-rear-20261121T115453.123Z-asked.pcap",
      "other-20261121T115453.123Z-asked.pcap",
      "terracut-20261121T115453.123Z-asked.pcap.part-x-1",
      "terracut-20261121T115453.123Z-asked.pcap.part-1",
  };
  for (const std::string& name : others) put(name);
  put("target");
  fs::create_symlink(folder_ / "target", folder_ / "terracut-20250101T000000.000Z-asked.pcap");
  fs::create_directory(folder_ / "terracut-20250101T000001.000Z-asked.pcap");
  const std::set<std::string> before = files();
  DumpFolderLimits one = limits();
  one.most_dumps = 1;
  one.most_bytes = 1000;
  DumpFolder dumps(one);
  for (const int age_s : {0, 10, 20}) write_dump(dumps, age_s, 900);
  EXPECT_EQ(dumps.deleted(), 2U);
  for (const std::string& name : before) EXPECT_TRUE(files().contains(name)) << name;
  EXPECT_EQ(files().size(), before.size() + 2);
}

TEST_F(DumpFolderTest, ClearsAwayWhatAKilledProcessLeftBehind) {
  const std::string dump = "terracut-20261121T115453.123Z-asked.pcap.part-";
  const std::string left = dump + std::to_string(dead_process()) + "-0";
  const std::string being_written = dump + std::to_string(::getppid()) + "-0";
  put(left);
  put(being_written);
  DumpFolder dumps(limits());
  ASSERT_TRUE(dumps.make_room(1, DumpReason::kAsked, kStart_ns).has_value());
  EXPECT_THAT(files(), UnorderedElementsAre(being_written));
}

TEST_F(DumpFolderTest, RefusesADumpLargerThanTheQuotaAndDeletesNothing) {
  DumpFolderLimits small = limits();
  small.most_bytes = 10'000;
  DumpFolder dumps(small);
  write_dump(dumps, 0);
  EXPECT_EQ(refusal_of(dumps, 10'001), DumpRefusal::kOverQuota);
  EXPECT_EQ(files().size(), 2U);
}

TEST_F(DumpFolderTest, RefusesWhenFreeSpaceWouldFallUnderTheFloorAndDeletesNothing) {
  DumpFolderLimits generous = limits();
  generous.most_dumps = 1;
  DumpFolder before(generous);
  write_dump(before, 0);
  generous.least_free_bytes = std::numeric_limits<std::uint64_t>::max() / 2;
  DumpFolder dumps(generous);
  EXPECT_EQ(refusal_of(dumps, 1000), DumpRefusal::kDiskLow);
  EXPECT_EQ(files().size(), 2U);
}

TEST_F(DumpFolderTest, RefusesAFolderThatIsNone) {
  put("file");
  DumpFolderLimits wrong = limits();
  wrong.folder = folder_ / "file";
  DumpFolder dumps(wrong);
  EXPECT_EQ(refusal_of(dumps, 1000), DumpRefusal::kFolderUnusable);
  const auto unusable = dumps.check();
  ASSERT_FALSE(unusable);
  EXPECT_EQ(unusable.error().refusal, DumpRefusal::kFolderUnusable);
  wrong.folder = folder_ / "new" / "one";
  EXPECT_TRUE(DumpFolder(wrong).check());
  EXPECT_TRUE(fs::is_directory(wrong.folder));
}

TEST_F(DumpFolderTest, RefusesToKeepNothing) {
  DumpFolderLimits bad = limits();
  bad.most_dumps = 0;
  EXPECT_THROW(DumpFolder{bad}, std::invalid_argument);
  bad = limits();
  bad.most_bytes = 0;
  EXPECT_THROW(DumpFolder{bad}, std::invalid_argument);
  bad = limits();
  bad.folder.clear();
  EXPECT_THROW(DumpFolder{bad}, std::invalid_argument);
  DumpFolderLimits least = limits();
  least.most_dumps = 1;
  least.most_bytes = 1;
  EXPECT_NO_THROW(DumpFolder{least});
}

TEST_F(DumpFolderTest, RefusesNamesThatAreNoPartOfAFileName) {
  for (const char* name : {"", "a/b", "../a", "a b", "\n"}) {
    DumpFolderLimits bad = limits();
    bad.name = name;
    EXPECT_THROW(DumpFolder{bad}, std::invalid_argument) << name;
  }
  EXPECT_TRUE(recorder::is_dump_name("front-left_2.5"));
  EXPECT_FALSE(recorder::is_dump_name(std::string(65, 'a')));
}

}  // namespace
}  // namespace terracut::test
