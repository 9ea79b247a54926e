// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/message_thread.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <regex>
#include <string>

namespace terracut::cli {
namespace {

using testing::HasSubstr;

int errors = 0;

/// A pipe that nobody reads until read_all() does.
class Messages : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(::pipe2(ends_.data(), O_CLOEXEC), 0); }
  void TearDown() override {
    for (const int end : ends_) ::close(end);
  }
  [[nodiscard]] int there() const { return ends_[1]; }
  void fill() const {
    ::fcntl(there(), F_SETFL, O_NONBLOCK);
    const std::string some(4096, '.');
    while (::write(there(), some.data(), some.size()) > 0) {
    }
    ::fcntl(there(), F_SETFL, 0);
  }
  /// What was written, up to `end`, and what came with it.
  [[nodiscard]] std::string read_until(const std::string& end) const {
    std::string text;
    std::array<char, 65536> part{};
    while (text.find(end) == std::string::npos) {
      const ::ssize_t got = ::read(ends_[0], part.data(), part.size());
      if (got <= 0) break;
      text.append(part.data(), static_cast<std::size_t>(got));
    }
    return text;
  }

  std::array<int, 2> ends_{};
  MessageThread::OnError on_error_ = [](int, int) { ++errors; };
};

/// The sum of all losses that `text` tells of.
std::uint64_t told_as_lost(const std::string& text) {
  const std::regex loss("warning: ([0-9]+) messages before this one are lost");
  std::uint64_t sum = 0;
  for (std::sregex_iterator found(text.begin(), text.end(), loss), end; found != end; ++found) {
    sum += std::stoull((*found)[1]);
  }
  return sum;
}

TEST_F(Messages, AreWrittenInOrder) {
  MessageThread thread(on_error_);
  for (const char* text : {"a\n", "b\n", "c\n"}) thread.put(there(), text);
  EXPECT_TRUE(thread.finish(std::chrono::hours(1)));
  EXPECT_EQ(read_until("c\n"), "a\nb\nc\n");
  EXPECT_EQ(thread.lost(), 0U);
}

TEST_F(Messages, ThatNobodyTakesHoldUpNobodyAndAreCountedWhereTheyFindNoRoom) {
  fill();
  MessageThread thread(on_error_);
  constexpr std::size_t kMore = 10;
  // The thread takes the first of them at any time while they are put, so one more may be taken.
  for (std::size_t n = 0; n < MessageThread::kMostWaiting + 1 + kMore; ++n) {
    thread.put(there(), std::to_string(n) + "\n");
  }
  EXPECT_GE(thread.lost(), kMore);
  EXPECT_LE(thread.lost(), kMore + 1);
  EXPECT_FALSE(thread.finish(std::chrono::milliseconds(1)));
  const std::string waiting = std::to_string(MessageThread::kMostWaiting - 1) + "\n";
  std::string written = read_until(waiting);
  EXPECT_THAT(written, HasSubstr("\n1\n2\n3\n"));
  EXPECT_TRUE(thread.finish(std::chrono::hours(1)));
  thread.put(there(), "the next\n");
  EXPECT_TRUE(thread.finish(std::chrono::hours(1)));
  written += read_until("the next\n");
  EXPECT_EQ(told_as_lost(written), thread.lost());
}

TEST_F(Messages, ThatCannotBeWrittenAreNoReasonToStop) {
  errors = 0;
  MessageThread thread(on_error_);
  const int full = ::open("/dev/full", O_WRONLY | O_CLOEXEC);
  thread.put(full, "lost\n");
  thread.put(there(), "written\n");
  EXPECT_TRUE(thread.finish(std::chrono::hours(1)));
  ::close(full);
  EXPECT_EQ(errors, 1);
  EXPECT_EQ(read_until("\n"), "written\n");
}

}  // namespace
}  // namespace terracut::cli
