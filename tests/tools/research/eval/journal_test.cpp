// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/research/eval/journal.hpp"

#include <gmock/gmock.h>

#include <thread>

#include "tests/support/scratch_folder.hpp"

namespace terracut::eval {
namespace {

using testing::HasSubstr;
using testing::Not;

class JournalTest : public testing::Test {
 protected:
  [[nodiscard]] std::string content() const { return test::content_of(path_); }
  [[nodiscard]] FrameResults reopened() const {
    auto journal = Journal::open(path_, "settings");
    EXPECT_TRUE(journal) << journal.error().message;
    return journal ? journal->take_results() : FrameResults{};
  }

  test::ScratchFolder folder_;
  std::filesystem::path path_ = folder_.path() / "sub" / "a.journal";
};

FrameResult result(std::uint64_t points) {
  FrameResult result;
  result.points = points;
  result.non_finite = 1;
  result.no_ring = 2;
  result.not_placed = 3;
  result.rings_realigned = true;
  result.counts.add({40, 2}, {points, 7, 3});
  result.tall = {points, 8};
  result.flips = {points, 10, 9};
  result.times.stage_ns = {1, 2, 3, 4, 5};
  result.times.decode_ns = 6;
  result.times.segment_ns = 15;
  return result;
}

TEST_F(JournalTest, GivesBackWhatWasAdded) {
  {
    auto journal = Journal::open(path_, "settings");
    ASSERT_TRUE(journal) << journal.error().message;
    EXPECT_TRUE(journal->take_results().empty());
    ASSERT_TRUE(journal->add({"00", "000001", "paper"}, result(100)));
    ASSERT_TRUE(journal->add({"00", "000002", "paper"}, result(200)));
  }
  const FrameResults found = reopened();
  ASSERT_EQ(found.size(), 2U);
  const FrameResult& second = found.at({"00", "000002", "paper"});
  const FrameResult expected = result(200);
  EXPECT_EQ(second.counts, expected.counts);
  EXPECT_EQ(second.tall, expected.tall);
  EXPECT_EQ(second.flips, expected.flips);
  EXPECT_EQ(second.points, expected.points);
  EXPECT_EQ(second.non_finite, expected.non_finite);
  EXPECT_EQ(second.no_ring, expected.no_ring);
  EXPECT_EQ(second.not_placed, expected.not_placed);
  EXPECT_EQ(second.rings_realigned, expected.rings_realigned);
  EXPECT_EQ(second.times.stage_ns, expected.times.stage_ns);
  EXPECT_EQ(second.times.decode_ns, expected.times.decode_ns);
  EXPECT_EQ(second.times.segment_ns, expected.times.segment_ns);
}

TEST_F(JournalTest, LosesOnlyTheLineThatWasTornAndGoesOnBehindTheRest) {
  {
    auto journal = Journal::open(path_, "settings");
    ASSERT_TRUE(journal->add({"00", "000001", "paper"}, result(100)));
    ASSERT_TRUE(journal->add({"00", "000002", "paper"}, result(200)));
  }
  const std::string whole = content();
  const std::size_t first_two_lines = whole.find('\n', whole.find('\n') + 1) + 1;
  for (std::size_t bytes = first_two_lines; bytes < whole.size(); bytes += 13) {
    std::ofstream(path_, std::ios::binary) << whole.substr(0, bytes);
    {
      auto journal = Journal::open(path_, "settings");
      ASSERT_TRUE(journal) << journal.error().message;
      EXPECT_EQ(journal->take_results().size(), 1U) << bytes;
      ASSERT_TRUE(journal->add({"00", "000003", "paper"}, result(300)));
    }
    EXPECT_EQ(reopened().size(), 2U) << bytes;
  }
}

TEST_F(JournalTest, BeginsAnewWhereNotEvenTheFirstLineIsWhole) {
  {
    ASSERT_TRUE(Journal::open(path_, "settings"));
  }
  const std::string whole = content();
  std::ofstream(path_, std::ios::binary) << whole.substr(0, whole.size() / 2);
  EXPECT_TRUE(reopened().empty());
  EXPECT_EQ(content(), whole);
}

TEST_F(JournalTest, OfOtherSettingsIsRefusedAndLeftAlone) {
  {
    auto journal = Journal::open(path_, "settings");
    ASSERT_TRUE(journal->add({"00", "000001", "paper"}, result(100)));
  }
  const std::string before = content();
  const auto other = Journal::open(path_, "other settings");
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(other.error().message, HasSubstr("other settings"));
  EXPECT_EQ(content(), before);
}

TEST_F(JournalTest, SaysWhichSettingsDiffer) {
  ASSERT_TRUE(Journal::open(path_, "0.1.0 mount=1.73,0,0 zhang{sectors=180 band_m=1}"));
  const auto other = Journal::open(path_, "0.1.0 mount=1.73,0,0 zhang{sectors=90 band_m=1}");
  ASSERT_FALSE(other);
  EXPECT_THAT(other.error().message, HasSubstr("there: zhang{sectors=180\n"));
  EXPECT_THAT(other.error().message, HasSubstr("now:   zhang{sectors=90"));
  EXPECT_THAT(other.error().message, Not(HasSubstr("mount")));
}

TEST_F(JournalTest, IsWrittenByOneEvaluationAtATime) {
  {
    const auto first = Journal::open(path_, "settings");
    ASSERT_TRUE(first) << first.error().message;
    const auto second = Journal::open(path_, "settings");
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, ErrorCode::kInvalidArgument);
    EXPECT_THAT(second.error().message, HasSubstr("another evaluation is writing it"));
  }
  EXPECT_TRUE(Journal::open(path_, "settings"));
}

TEST_F(JournalTest, IsNotWrittenOverAFileOfSomebodyElse) {
  folder_.write("sub/a.journal", "my diary\n");
  const auto journal = Journal::open(path_, "settings");
  ASSERT_FALSE(journal);
  EXPECT_THAT(journal.error().message, HasSubstr("no journal"));
  EXPECT_EQ(content(), "my diary\n");
}

TEST_F(JournalTest, NamesTheLineThatIsNoResult) {
  {
    ASSERT_TRUE(Journal::open(path_, "settings"));
  }
  std::ofstream(path_, std::ios::app) << "{\"sequence\": 3}\n";
  const auto journal = Journal::open(path_, "settings");
  ASSERT_FALSE(journal);
  EXPECT_THAT(journal.error().message, HasSubstr("line 2"));
}

TEST_F(JournalTest, TakesWholeLinesFromManyThreads) {
  constexpr int kThreads = 4, kEach = 200;
  {
    auto journal = Journal::open(path_, "settings");
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < kThreads; ++thread) {
      threads.emplace_back([&, thread] {
        for (int i = 0; i < kEach; ++i) {
          EXPECT_TRUE(
              journal->add({std::to_string(thread), std::to_string(i), "paper"}, result(1)));
        }
      });
    }
  }
  EXPECT_EQ(reopened().size(), std::size_t{kThreads * kEach});
}

TEST_F(JournalTest, SaysThatItCannotBeWritten) {
  folder_.write("sub", "a file where a folder should be");
  const auto journal = Journal::open(path_, "settings");
  ASSERT_FALSE(journal);
  EXPECT_EQ(journal.error().code, ErrorCode::kWriteFailed);
}

}  // namespace
}  // namespace terracut::eval
