// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/page/status_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>

#include "pipeline/page/status_page_list.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/child_process.hpp"

namespace terracut::page {
namespace {

/// Words that belong together, and an end that fills no word.
struct Health {
  std::array<std::uint64_t, 12> words{};
  std::array<std::uint8_t, 5> end{};

  static Health of(std::uint64_t number) {
    Health health;
    for (std::size_t i = 0; i < health.words.size(); ++i) health.words[i] = number * (2 * i + 1);
    health.end.fill(static_cast<std::uint8_t>(number));
    return health;
  }
  bool operator==(const Health&) const = default;
};
constexpr std::uint32_t kLayout = 3;

/// Each test has a folder of its own in memory, which goes with it.
class StatusPage : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory("/dev/shm")) GTEST_SKIP() << "no /dev/shm here";
    std::string pattern = "/dev/shm/terracut_test_XXXXXX";
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override {
    if (!folder_.empty()) std::filesystem::remove_all(folder_);
  }
  [[nodiscard]] auto publisher(const std::string& name = "page") const {
    return StatusPagePublisher<Health>::create(name, kLayout, folder_);
  }
  [[nodiscard]] auto reader(const std::string& name = "page") const {
    return StatusPageReader<Health>::open(name, kLayout, folder_);
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_), {}));
  }
  /// Makes a page in a process of its own, which then ends without tidying up.
  void leave_a_page_of_a_dead_process() const {
    ASSERT_EQ(test::in_child_process([&]() -> std::string {
                auto page = publisher();
                if (!page) return page.error().message;
                page->publish(Health::of(77));
                new StatusPagePublisher<Health>(std::move(*page));  // outlives this function
                return "";
              }),
              "");
  }
  std::filesystem::path folder_;
};

TEST_F(StatusPage, HoldsNothingBeforeTheFirstPublication) {
  const auto page = publisher();
  ASSERT_TRUE(page.has_value()) << page.error().message;
  const auto view = reader();
  ASSERT_TRUE(view.has_value()) << view.error().message;
  EXPECT_EQ(view->read(), std::nullopt);
  EXPECT_EQ(view->publications(), 0U);
}

TEST_F(StatusPage, GivesTheNewestToAllReaders) {
  auto page = publisher();
  const auto first = reader();
  ASSERT_TRUE(page && first);
  page->publish(Health::of(1));
  EXPECT_EQ(first->read(), Health::of(1));
  page->publish(Health::of(2));
  const auto second = reader();
  ASSERT_TRUE(second);
  EXPECT_EQ(first->read(), Health::of(2));
  EXPECT_EQ(second->read(), Health::of(2));
  EXPECT_EQ(second->publications(), 2U);
}

TEST_F(StatusPage, TellsWhoPublishesSinceWhen) {
  const auto page = publisher();
  const auto view = reader();
  ASSERT_TRUE(page && view);
  EXPECT_TRUE(view->publisher_lives());
  EXPECT_EQ(view->publisher_pid(), ::getpid());
  constexpr std::int64_t kYear2020_ns = 1'577'836'800'000'000'000;
  EXPECT_GT(view->started_ns(), kYear2020_ns);
}

TEST_F(StatusPage, IsReadableForOthersAndWritableForNone) {
  const ::mode_t before = ::umask(022);
  const auto page = publisher();
  ::umask(before);
  ASSERT_TRUE(page);
  struct stat status {};
  ASSERT_EQ(::stat(page->path().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0644U);
}

TEST_F(StatusPage, GoesWithItsPublisherWhileReadersKeepTheLastValue) {
  auto page = publisher();
  const auto view = reader();
  ASSERT_TRUE(page && view);
  page->publish(Health::of(5));
  { const auto gone = std::move(*page); }
  EXPECT_EQ(files(), 0U);
  EXPECT_FALSE(view->publisher_lives());
  EXPECT_EQ(view->read(), Health::of(5));
}

TEST_F(StatusPage, OfADeadProcessIsRecognisedAndStillReadable) {
  leave_a_page_of_a_dead_process();
  const auto view = reader();
  ASSERT_TRUE(view.has_value()) << view.error().message;
  EXPECT_FALSE(view->publisher_lives());
  EXPECT_NE(view->publisher_pid(), ::getpid());
  EXPECT_EQ(view->read(), Health::of(77));
}

TEST_F(StatusPage, OfADeadProcessIsReplaced) {
  leave_a_page_of_a_dead_process();
  auto page = publisher();
  ASSERT_TRUE(page.has_value()) << page.error().message;
  page->publish(Health::of(8));
  const auto view = reader();
  ASSERT_TRUE(view);
  EXPECT_TRUE(view->publisher_lives());
  EXPECT_EQ(view->read(), Health::of(8));
  EXPECT_EQ(files(), 1U);
}

TEST_F(StatusPage, TakesAwayNoPageButItsOwnWhenItGoes) {
  auto page = publisher();
  ASSERT_TRUE(page);
  std::filesystem::remove(page->path());  // somebody tidied up
  auto successor = publisher();
  ASSERT_TRUE(successor.has_value()) << successor.error().message;
  successor->publish(Health::of(4));
  { const auto gone = std::move(*page); }
  const auto view = reader();
  ASSERT_TRUE(view.has_value()) << view.error().message;
  EXPECT_EQ(view->read(), Health::of(4));
}

TEST_F(StatusPage, OfALivingProcessIsNotReplaced) {
  auto page = publisher();
  ASSERT_TRUE(page);
  const auto second = publisher();
  ASSERT_FALSE(second.has_value());
  EXPECT_EQ(second.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(second.error().message,
              testing::HasSubstr("in use by process " + std::to_string(::getpid())));
  page->publish(Health::of(1));
  EXPECT_EQ(reader()->read(), Health::of(1));
  EXPECT_EQ(files(), 1U) << "the refused one left nothing behind";
}

TEST_F(StatusPage, IsMadeByOneOfManyWhoTryAtOnce) {
  leave_a_page_of_a_dead_process();
  constexpr int kThreads = 8;
  for (int round = 0; round < 20; ++round) {
    std::array<std::optional<StatusPagePublisher<Health>>, kThreads> made;
    std::array<std::thread, kThreads> threads;
    for (int n = 0; n < kThreads; ++n) {
      threads[static_cast<std::size_t>(n)] = std::thread([&, n] {
        auto page = publisher();
        if (page) made[static_cast<std::size_t>(n)].emplace(std::move(*page));
      });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(std::count_if(made.begin(), made.end(), [](const auto& m) { return m.has_value(); }),
              1);
    EXPECT_EQ(files(), 1U);
  }
}

TEST_F(StatusPage, IsNotHarmedByAReaderThatIsKilled) {
  auto page = publisher();
  ASSERT_TRUE(page);
  page->publish(Health::of(1));
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const ::pid_t child = ::fork();
  if (child == 0) {
    const auto view = reader();
    const char sign = view && view->read() == Health::of(1) ? 'y' : 'n';
    (void)!::write(ready[1], &sign, 1);
    while (view && view->publisher_lives()) (void)view->read();
    ::_exit(0);
  }
  char sign = 0;
  ASSERT_EQ(::read(ready[0], &sign, 1), 1);
  EXPECT_EQ(sign, 'y');
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  ::close(ready[0]);
  ::close(ready[1]);
  page->publish(Health::of(2));
  const auto view = reader();
  ASSERT_TRUE(view);
  EXPECT_EQ(view->read(), Health::of(2));
  EXPECT_TRUE(view->publisher_lives());
}

/// A publisher killed in the midst of a publication leaves an odd sequence for good.
TEST_F(StatusPage, GivesNothingRatherThanHalfAValue) {
  auto file = StatusPageFile::create(folder_, "page", kLayout, sizeof(Health));
  ASSERT_TRUE(file);
  file->words()[0].store(1);
  file->header()->sequence.store(7);
  const auto view = reader();
  ASSERT_TRUE(view);
  EXPECT_EQ(view->read(), std::nullopt);
}

TEST_F(StatusPage, IsNeverTornAndNeverGoesBackForReadersOfOtherThreads) {
  constexpr int kReadings = 20'000;
  auto page = publisher();
  ASSERT_TRUE(page);
  std::atomic<int> at_work{2};
  std::atomic<std::uint64_t> wrong{0};
  std::atomic<std::uint64_t> backwards{0};
  const auto read = [&] {
    const auto view = reader();
    std::uint64_t last = 0;
    for (int readings = 0; view && readings < kReadings;) {
      const auto health = view->read();
      if (!health) continue;
      const std::uint64_t number = health->words[0];
      wrong += *health == Health::of(number) ? 0 : 1;
      backwards += number >= last ? 0 : 1;
      last = number;
      ++readings;
    }
    --at_work;
  };
  std::array<std::thread, 2> readers{std::thread(read), std::thread(read)};
  for (std::uint64_t number = 1; at_work > 0; ++number) page->publish(Health::of(number));
  for (std::thread& thread : readers) thread.join();
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(backwards, 0U);
}

TEST_F(StatusPage, AllocatesNothingToPublishAndToRead) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "the sanitizer brings its own allocator";
  auto page = publisher();
  const auto view = reader();
  ASSERT_TRUE(page && view);
  const std::uint64_t before = test::allocations_of_this_thread();
  bool same = true;
  for (std::uint64_t number = 1; number < 100; ++number) {
    page->publish(Health::of(number));
    same = view->read() == Health::of(number) && same;
  }
  EXPECT_EQ(test::allocations_of_this_thread(), before);
  EXPECT_TRUE(same);
}

TEST_F(StatusPage, RefusesWhatItCannotRead) {
  const auto refused = [&](const std::string& name) {
    const auto view = reader(name);
    return view ? std::nullopt : std::optional(view.error().code);
  };
  EXPECT_EQ(refused("absent"), ErrorCode::kNotFound);
  EXPECT_EQ(refused("../page"), ErrorCode::kInvalidArgument);
  EXPECT_EQ(refused(""), ErrorCode::kInvalidArgument);

  std::ofstream(folder_ / "empty.terracut").close();
  EXPECT_EQ(refused("empty"), ErrorCode::kMalformed);
  std::ofstream(folder_ / "text.terracut") << std::string(1000, 'x');
  EXPECT_EQ(refused("text"), ErrorCode::kMalformed);
  ASSERT_EQ(::mkfifo((folder_ / "pipe.terracut").c_str(), 0644), 0);
  EXPECT_EQ(refused("pipe"), ErrorCode::kMalformed);
  std::filesystem::create_directory(folder_ / "folder.terracut");
  EXPECT_EQ(refused("folder"), ErrorCode::kMalformed);

  auto page = publisher("cut");
  ASSERT_TRUE(page);
  page->publish(Health::of(1));
  std::filesystem::copy_file(page->path(), folder_ / "short.terracut");
  std::filesystem::resize_file(folder_ / "short.terracut", 100);
  EXPECT_EQ(refused("short"), ErrorCode::kMalformed);
}

TEST_F(StatusPage, RefusesOneThatAnybodyCouldHaveMade) {
  const auto page = publisher();
  ASSERT_TRUE(page);
  namespace fs = std::filesystem;
  fs::permissions(page->path(), fs::perms::others_write, fs::perm_options::add);
  auto refused = reader();
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::kUnreadable);
  EXPECT_THAT(refused.error().message, testing::HasSubstr("written to by others"));
  EXPECT_TRUE(list_status_pages(folder_).empty());
  fs::permissions(page->path(), fs::perms::others_write, fs::perm_options::remove);
  EXPECT_TRUE(reader());
  EXPECT_EQ(list_status_pages(folder_).size(), 1U);
  if (::chown(page->path().c_str(), 1234, 1234) != 0) return;  // only root can give files away
  refused = reader();
  ASSERT_FALSE(refused.has_value());
  EXPECT_THAT(refused.error().message, testing::HasSubstr("belongs to user 1234"));
  EXPECT_TRUE(list_status_pages(folder_).empty());
}

TEST_F(StatusPage, RefusesAnotherLayout) {
  const auto page = publisher();
  ASSERT_TRUE(page);
  const auto newer = StatusPageReader<Health>::open("page", kLayout + 1, folder_);
  ASSERT_FALSE(newer.has_value());
  EXPECT_EQ(newer.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(newer.error().message, testing::HasSubstr("layout 3"));
  const auto smaller = StatusPageReader<std::uint64_t>::open("page", kLayout, folder_);
  ASSERT_FALSE(smaller.has_value());
  EXPECT_EQ(smaller.error().code, ErrorCode::kUnsupported);
}

TEST_F(StatusPage, IsMadeOnlyInMemoryAndUnderASoundName) {
  for (const char* name : {"a/b", "a b", "a~", "[a]", "a:b", ""}) {
    const auto refused = publisher(name);
    ASSERT_FALSE(refused.has_value()) << name;
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument) << name;
  }
  EXPECT_TRUE(publisher("azAZ09-_." + std::to_string(::getpid())).has_value());
  EXPECT_EQ(publisher(std::string(65, 'a')).error().code, ErrorCode::kInvalidArgument);
  const auto nowhere =
      StatusPagePublisher<Health>::create("page", kLayout, folder_ / "no such folder");
  ASSERT_FALSE(nowhere.has_value());
  EXPECT_EQ(nowhere.error().code, ErrorCode::kWriteFailed);
  const auto not_memory = StatusPagePublisher<Health>::create("page", kLayout, "/proc");
  ASSERT_FALSE(not_memory.has_value());
  EXPECT_EQ(not_memory.error().code, ErrorCode::kUnsupported);
}

}  // namespace
}  // namespace terracut::page
