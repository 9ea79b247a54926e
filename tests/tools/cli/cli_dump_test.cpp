// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// `terracut dump` and processes of all kinds that it may find.
#include <poll.h>
#include <sys/types.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "cli_fixture.hpp"
#include "firmware_io/capture/capture_source.hpp"
#include "pipeline/page/status_page.hpp"
#include "pipeline/recorder/flight_recorder.hpp"
#include "tools/cli/commands/dump_answer.hpp"
#include "tools/cli/live/dump_signal.hpp"

namespace terracut::cli {
namespace {

using recorder::DumpLimits;
using recorder::DumpPolicy;
using recorder::FlightRecorder;
using testing::HasSubstr;
using Page = page::StatusPagePublisher<std::uint64_t>;

/// A child process that stands for a running `terracut live`. It ends with this object.
class Child {
 public:
  /// Returns when `body` has called the function it is given, or has ended.
  explicit Child(const std::function<void(const std::function<void()>&)>& body) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    pid_ = ::fork();
    if (pid_ == 0) {
      ::close(ends[0]);
      body([&] { static_cast<void>(!::write(ends[1], "!", 1)); });
      ::_exit(0);
    }
    ::close(ends[1]);
    char ready = 0;
    static_cast<void>(!::read(ends[0], &ready, 1));
    ::close(ends[0]);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() { end(SIGKILL); }

  /// How it ended, after this signal: as waitpid() says.
  int end(int signal) {
    if (pid_ <= 0) return 0;
    int status = 0;
    ::kill(pid_, signal);
    ::waitpid(pid_, &status, 0);
    pid_ = -1;
    return status;
  }
  [[nodiscard]] bool lives() const { return ::waitpid(pid_, nullptr, WNOHANG) == 0; }
  [[nodiscard]] ::pid_t pid() const { return pid_; }

 private:
  ::pid_t pid_ = -1;
};

class CliDump : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    fs::create_directory(pages_);
    ::setenv("TERRACUT_STATUS_FOLDER", pages_.c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("TERRACUT_STATUS_FOLDER");
    fs::remove_all(pages_);
    Cli::TearDown();
  }

  [[nodiscard]] DumpLimits limits() const {
    DumpLimits limits;
    limits.folder.folder = folder_ / "dumps";
    limits.folder.least_free_bytes = 0;
    limits.asked = {.interval_s = 1000, .burst = 2};
    return limits;
  }
  /// Records `datagrams`, and dumps them whenever it is asked.
  [[nodiscard]] auto recording(const std::string& name, int datagrams = 50) const {
    return [=, this](const std::function<void()>& ready) {
      DumpSignal signal;
      const auto page = Page::create(name, 1);
      DumpAnswers answers(page::status_page_folder(), name);
      memory::FixedMemory memory;
      FlightRecorder recorder({100, 120'800}, memory);
      const std::vector<std::uint8_t> payload(1206);
      for (int n = 0; n < datagrams; ++n) {
        recorder.add({.payload = payload, .stamp_ns = 1'000'000'000 + n * std::int64_t{1'000'000}});
      }
      DumpPolicy policy(limits());
      ready();
      for (pollfd listening{signal.descriptor(), POLLIN, 0}; ::poll(&listening, 1, 20'000) > 0;) {
        if (!signal.take()) continue;
        static_cast<void>(answers.publish(recorder.dump(policy, recorder::DumpReason::kAsked, {})));
      }
    };
  }
  /// Says that it wrote these files whenever it is asked.
  [[nodiscard]] static auto answering(const fs::path& capture, const fs::path& calibration) {
    return [=](const std::function<void()>& ready) {
      DumpSignal signal;
      const auto page = Page::create("front", 1);
      DumpAnswers answers(page::status_page_folder(), "front");
      ready();
      for (pollfd listening{signal.descriptor(), POLLIN, 0}; ::poll(&listening, 1, 20'000) > 0;) {
        if (!signal.take()) continue;
        recorder::DumpReport report;
        report.capture = capture;
        report.calibration = calibration;
        static_cast<void>(answers.publish(report));
      }
    };
  }

  const fs::path pages_ = "/dev/shm/terracut_cli_dump_test_" + std::to_string(::getpid());
};

TEST_F(CliDump, HasTheOnlyRunningProcessWriteItsPacketsAndPrintsTheFile) {
  Child live(recording("front"));
  const Outcome outcome = run("dump");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("50 datagrams of 0.05 s"));
  const std::string file = outcome.out.substr(0, outcome.out.find('\n'));
  auto capture = capture::CaptureSource::open(file);
  ASSERT_TRUE(capture) << capture.error().message;
  int datagrams = 0;
  for (auto next = capture->next(); next && *next; next = capture->next()) ++datagrams;
  EXPECT_EQ(datagrams, 50);
  EXPECT_TRUE(fs::exists(recorder::frame_times_path(file)));
  EXPECT_TRUE(live.lives());
}

TEST_F(CliDump, TellsWhyADumpWasRefused) {
  Child live(recording("front", 0));
  const Outcome empty = run("dump front");
  EXPECT_EQ(empty.exit_code, 4);
  EXPECT_THAT(empty.err, HasSubstr("refused (nothing_held)"));
  EXPECT_THAT(run("dump front").err, HasSubstr("refused (nothing_held)")) << "a second answer";
  EXPECT_THAT(run("dump front").err, HasSubstr("refused (too_soon)"));
}

TEST_F(CliDump, AsksTheProcessThatIsNamed) {
  Child front(recording("front", 10)), rear(recording("rear", 20));
  const Outcome unnamed = run("dump");
  EXPECT_EQ(unnamed.exit_code, 2);
  EXPECT_THAT(unnamed.err, HasSubstr("front, rear"));
  EXPECT_THAT(run("dump rear").err, HasSubstr("20 datagrams"));
  EXPECT_THAT(run("dump front").err, HasSubstr("10 datagrams"));
  const Outcome unknown = run("dump roof");
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.err, HasSubstr("'roof'"));
}

TEST_F(CliDump, SaysWhenNoneIsRunning) {
  EXPECT_EQ(run("dump").exit_code, 3);
  Child live(recording("front"));
  EXPECT_EQ(run("dump").exit_code, 0);
  live.end(SIGKILL);
  const Outcome after = run("dump");
  EXPECT_EQ(after.exit_code, 3);
  EXPECT_THAT(after.err, HasSubstr("no `terracut live` is running"));
}

TEST_F(CliDump, NeverEndsAProcessThatDoesNotListen) {
  Child deaf([&](const std::function<void()>& ready) {
    const auto page = Page::create("deaf", 1);
    ready();
    ::pause();
  });
  const Outcome outcome = run("dump");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("does not listen"));
  EXPECT_TRUE(deaf.lives());
}

TEST_F(CliDump, GivesUpWaitingForAnAnswer) {
  Child stuck([&](const std::function<void()>& ready) {
    const DumpSignal signal;
    const auto page = Page::create("stuck", 1);
    ready();
    ::pause();
  });
  const Outcome outcome = run("dump --wait 0.2");
  EXPECT_EQ(outcome.exit_code, 4);
  EXPECT_THAT(outcome.err, HasSubstr("has not answered within 0.2 s"));
  EXPECT_TRUE(stuck.lives());
}

TEST_F(CliDump, ASignalFromAnywhereElseDumpsAsWell) {
  Child live(recording("front"));
  ASSERT_EQ(::kill(live.pid(), SIGUSR1), 0);
  std::optional<DumpAnswer> answer;
  for (int i = 0; i < 2000 && !answer; ++i) {
    ::usleep(10'000);
    answer = read_dump_answer(page::status_page_folder(), "front");
  }
  ASSERT_TRUE(answer.has_value());
  EXPECT_EQ(answer->serial, 1U);
  EXPECT_EQ(answer->pid, live.pid());
  EXPECT_TRUE(fs::exists(answer->capture)) << answer->message;
}

TEST_F(CliDump, HearsNoAnswerThatAnybodyCouldHaveWritten) {
  const fs::path answer = pages_ / "front.terracut-dump";
  std::ofstream(answer) << R"({"pid": 1, "serial": 1, "capture": "/evil"})";
  EXPECT_TRUE(read_dump_answer(pages_, "front"));
  fs::permissions(answer, fs::perms::others_write, fs::perm_options::add);
  EXPECT_FALSE(read_dump_answer(pages_, "front"));
  fs::remove(answer);
  std::ofstream(pages_ / "elsewhere") << R"({"pid": 1, "serial": 1, "capture": "/evil"})";
  fs::create_symlink(pages_ / "elsewhere", answer);
  EXPECT_FALSE(read_dump_answer(pages_, "front"));
}

TEST_F(CliDump, PrintsNothingThatATerminalWouldObey) {
  Child live(answering("/dumps/\x1b[2J.pcap", "/dumps/\x1b[2J.xml"));
  const Outcome outcome = run("dump");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "/dumps/?[2J.pcap\n");
  EXPECT_THAT(outcome.err,
              HasSubstr("terracut replay /dumps/?[2J.pcap --calibration /dumps/?[2J.xml"));
}

TEST_F(CliDump, PrintsPlacesThatAreRightInEveryFolder) {
  const fs::path here = fs::current_path();  // of the process that dumps; `dump` runs elsewhere
  Child live(answering("dumps/a.pcap", "dumps/a.xml"));
  const Outcome outcome = run("dump");
  EXPECT_EQ(outcome.out, (here / "dumps/a.pcap").string() + "\n");
  EXPECT_THAT(outcome.err, HasSubstr("terracut replay " + (here / "dumps/a.pcap").string() +
                                     " --calibration " + (here / "dumps/a.xml").string() + "\n"));
}

TEST_F(CliDump, AnAnswerIsTakenAwayWithItsProcess) {
  {
    DumpAnswers answers(page::status_page_folder(), "front");
    ASSERT_TRUE(answers.publish(
        tl::unexpected(recorder::RefusedDump{recorder::DumpRefusal::kDiskLow, "no room"})));
    const auto answer = read_dump_answer(page::status_page_folder(), "front");
    ASSERT_TRUE(answer.has_value());
    EXPECT_EQ(answer->refusal, "disk_low");
    EXPECT_EQ(answer->message, "no room");
  }
  EXPECT_FALSE(read_dump_answer(page::status_page_folder(), "front").has_value());
  std::ofstream(pages_ / "front.terracut-dump") << "[1, 2]";
  EXPECT_FALSE(read_dump_answer(page::status_page_folder(), "front").has_value());
  std::ofstream(pages_ / "front.terracut-dump") << R"({"pid": "x", "serial": 1})";
  EXPECT_FALSE(read_dump_answer(page::status_page_folder(), "front").has_value());
}

}  // namespace
}  // namespace terracut::cli
