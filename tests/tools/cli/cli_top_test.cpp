// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// `terracut top`, a process of its own, attached to the status page of this one.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <stdexcept>

#include "cli_fixture.hpp"
#include "pipeline/page/status_page.hpp"
#include "tests/pipeline/status/watched_run.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"

namespace terracut::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kUsage = 2, kInputRefused = 3;

class CliTop : public Cli {
 protected:
  using Page = page::StatusPagePublisher<status::MonitorSnapshot>;

  void SetUp() override {
    Cli::SetUp();
    if (!fs::is_directory("/dev/shm")) GTEST_SKIP() << "there is no /dev/shm";
    pages_ = "/dev/shm/" + folder_.filename().string();
    fs::create_directories(pages_);
    ::setenv("TERRACUT_STATUS_FOLDER", pages_.c_str(), 1);
  }
  void TearDown() override {
    fs::remove_all(pages_);
    Cli::TearDown();
  }

  [[nodiscard]] Page publish(const std::string& name) {
    auto page = Page::create(name, status::MonitorSnapshot::kLayout, pages_);
    if (!page) throw std::runtime_error(page.error().message);
    page->publish(watched_.figures());
    return std::move(*page);
  }
  /// What a process leaves that is killed after it has published.
  void leave_page_of_killed_process() {
    const std::string end = test::in_child_process([&]() -> std::string {
      const Page page = publish("live");
      ::kill(::getpid(), SIGKILL);
      return "";
    });
    ASSERT_EQ(end, " killed by signal 9");
  }

  status::WatchedRun watched_;
  fs::path pages_;
};

TEST_F(CliTop, ShowsTheOnlyRunningProcessOnce) {
  const Page page = publish("live");
  const Outcome outcome = run("top --once");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("HDL-64E, 600.0 rpm"), HasSubstr("2 missed (2.000 %)"),
                                 HasSubstr("network_gap_packets 12"), HasSubstr("min_cut")));
  EXPECT_THAT(outcome.out, Not(HasSubstr("\x1b"))) << "colours though it is no terminal";
}

TEST_F(CliTop, PrintsJsonForPrograms) {
  const Page page = publish("live");
  const Outcome outcome = run("top --print-json live");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out, nullptr, false);
  EXPECT_EQ(json["frames"]["count"], 100);
  EXPECT_EQ(json["misses"]["causes"]["waiting_for_core"], 1);
}

TEST_F(CliTop, AsksWhichOfSeveralToShow) {
  const Page front = publish("front");
  const Page rear = publish("rear");
  const Outcome outcome = run("top --once");
  EXPECT_EQ(outcome.exit_code, kUsage);
  EXPECT_THAT(outcome.err, HasSubstr("front, rear"));
  EXPECT_EQ(run("top --once rear").exit_code, 0);
}

TEST_F(CliTop, SaysThatNothingRuns) {
  const Outcome outcome = run("top --once");
  EXPECT_EQ(outcome.exit_code, kInputRefused);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("no `terracut live` is running"), HasSubstr(pages_.string())));
  const Outcome named = run("top --once rear");
  EXPECT_EQ(named.exit_code, kInputRefused);
  EXPECT_THAT(named.err, HasSubstr("rear"));
}

TEST_F(CliTop, ShowsTheLastFiguresOfAKilledProcessAndSaysSo) {
  leave_page_of_killed_process();
  const Outcome unnamed = run("top --once");
  EXPECT_EQ(unnamed.exit_code, kInputRefused);
  EXPECT_THAT(unnamed.err, HasSubstr("'live' was left by process"));
  const Outcome named = run("top --once live");
  EXPECT_EQ(named.exit_code, kInputRefused);
  EXPECT_THAT(named.out, HasSubstr("2 missed"));
  EXPECT_THAT(named.err, HasSubstr("is gone"));
}

TEST_F(CliTop, EndsWhenTheProcessItWatchesEnds) {
  leave_page_of_killed_process();
  const Outcome outcome = run("top live");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("2 missed"));
  EXPECT_THAT(outcome.err, HasSubstr("has ended"));
}

TEST_F(CliTop, SaysThatNothingWasPublishedYet) {
  const auto page = Page::create("live", status::MonitorSnapshot::kLayout, pages_);
  ASSERT_TRUE(page);
  const Outcome outcome = run("top --once");
  EXPECT_EQ(outcome.exit_code, kInputRefused);
  EXPECT_THAT(outcome.err, HasSubstr("not published any figures yet"));
}

TEST_F(CliTop, RefusesThePageOfAnotherVersion) {
  const auto page = Page::create("live", status::MonitorSnapshot::kLayout + 1, pages_);
  ASSERT_TRUE(page);
  const Outcome outcome = run("top --once");
  EXPECT_EQ(outcome.exit_code, kInputRefused);
  EXPECT_THAT(outcome.err, HasSubstr("layout"));
}

TEST_F(CliTop, KilledWhileItReadsDisturbsNobody) {
  Page page = publish("live");
  const std::string out = (folder_ / "watched.txt").string();
  const pid_t reader = ::fork();
  if (reader == 0) {
    if (std::freopen(out.c_str(), "w", stdout) == nullptr) ::_exit(9);
    ::execl(test::program().c_str(), "terracut", "top", "live", "--interval", "0.1", nullptr);
    ::_exit(9);
  }
  int status = 0;
  while (content_of(out).empty() && ::waitpid(reader, &status, WNOHANG) == 0) ::usleep(1000);
  ::kill(reader, SIGKILL);
  ::waitpid(reader, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status)) << "it ended by itself before it was killed";
  watched_.figures().packets = 77'777;
  page.publish(watched_.figures());
  const Outcome outcome = run("top --once");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("77777 packets"));
}

}  // namespace
}  // namespace terracut::cli
