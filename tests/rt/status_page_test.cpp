// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "rt/status_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <fstream>
#include <functional>
#include <thread>

#include "tests/support/scratch_folder.hpp"

namespace terracut::rt {
namespace {

using testing::AllOf;
using testing::HasSubstr;

namespace fs = std::filesystem;

constexpr std::uint32_t kLayout = 3;

/// Long enough that a copy takes a while; whole if all words are equal.
struct Value {
  std::array<std::uint64_t, 2048> words;
};

Value value_of(std::uint64_t word) {
  Value value;
  value.words.fill(word);
  return value;
}

bool is_whole(const Value& value) {
  return std::all_of(value.words.begin(), value.words.end(),
                     [&](std::uint64_t word) { return word == value.words[0]; });
}

/// Another process, that says when it has done its preparations.
class Child {
 public:
  /// `life`: called in the child with a function that says "prepared"; the child ends after it.
  explicit Child(const std::function<void(const std::function<void()>&)>& life) {
    std::array<int, 2> ends{};
    if (::pipe(ends.data()) != 0) std::abort();
    pid_ = ::fork();
    if (pid_ == 0) {
      ::close(ends[0]);
      life([&] {
        const char byte = 1;
        if (::write(ends[1], &byte, 1) != 1) ::_exit(9);
      });
      ::_exit(0);
    }
    ::close(ends[1]);
    char byte = 0;
    prepared_ = ::read(ends[0], &byte, 1) == 1;
    ::close(ends[0]);
  }
  ~Child() { kill(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// kill -9, and waits until it is gone.
  void kill() {
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    pid_ = -1;
  }
  [[nodiscard]] bool prepared() const { return prepared_; }
  [[nodiscard]] pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = -1;
  bool prepared_ = false;
};

class StatusPageIn : public testing::Test {
 protected:
  void SetUp() override { folder_ = test::make_scratch_folder(); }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] auto create(std::string_view name = "page") const {
    return StatusPage<Value>::create(folder_, name, kLayout);
  }
  [[nodiscard]] auto open(std::string_view name = "page") const {
    return StatusPageView<Value>::open(folder_, name, kLayout);
  }
  [[nodiscard]] fs::path file() const { return folder_ / "terracut.page.status"; }

  fs::path folder_;
};

TEST_F(StatusPageIn, ShowsWhatWasPublishedLast) {
  auto page = create();
  ASSERT_TRUE(page) << page.error().message;
  const auto view = open();
  ASSERT_TRUE(view) << view.error().message;
  Value read;
  EXPECT_FALSE(view->read(read)) << "nothing was published yet";
  for (const std::uint64_t word : {7U, 8U}) {
    page->publish(value_of(word));
    ASSERT_TRUE(view->read(read));
    EXPECT_EQ(read.words, value_of(word).words);
  }
  EXPECT_TRUE(view->writer_lives());
  EXPECT_EQ(view->pid(), static_cast<std::uint32_t>(::getpid()));
  EXPECT_GT(view->started_ns(), 1'500'000'000'000'000'000);
}

TEST_F(StatusPageIn, IsReadableForAllAndGoesWithItsWriter) {
  {
    const auto page = create();
    ASSERT_TRUE(page);
    struct stat facts{};
    ASSERT_EQ(::stat(file().c_str(), &facts), 0);
    EXPECT_EQ(facts.st_mode & 0777U, 0644U);
  }
  EXPECT_FALSE(fs::exists(file()));
  EXPECT_EQ(open().error().code, ErrorCode::kNotFound);
}

TEST_F(StatusPageIn, NeverShowsAValueThatIsHalfOldHalfNew) {
  auto page = create();
  ASSERT_TRUE(page);
  const auto view = open();
  ASSERT_TRUE(view);
  constexpr std::uint64_t kLast = 1000;
  page->publish(value_of(0));
  std::thread writer([&] {
    for (std::uint64_t word = 1; word <= kLast; ++word) {
      page->publish(value_of(word));
      std::this_thread::yield();
    }
  });
  Value read;
  std::uint64_t newest = 0;
  while (newest < kLast) {
    if (!view->read(read)) continue;
    ASSERT_TRUE(is_whole(read));
    ASSERT_GE(read.words[0], newest);
    newest = read.words[0];
  }
  writer.join();
}

TEST_F(StatusPageIn, RefusesTheNameOfARunningProcessAndTellsItsPid) {
  const Child other([&](const auto& prepared) {
    auto page = create();
    if (page) prepared();
    ::pause();
  });
  ASSERT_TRUE(other.prepared());
  const auto page = create();
  ASSERT_FALSE(page);
  EXPECT_EQ(page.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(page.error().message,
              AllOf(HasSubstr("'page'"), HasSubstr(std::to_string(other.pid()))));
  EXPECT_TRUE(create("another"));
}

TEST_F(StatusPageIn, KeepsTheLastFiguresOfAKilledWriterAndSaysThatItIsGone) {
  Child other([&](const auto& prepared) {
    auto page = create();
    if (!page) return;
    page->publish(value_of(42));
    prepared();
    ::pause();
  });
  ASSERT_TRUE(other.prepared());
  const auto view = open();
  ASSERT_TRUE(view);
  EXPECT_TRUE(view->writer_lives());
  const auto pid = static_cast<std::uint32_t>(other.pid());
  other.kill();
  EXPECT_FALSE(view->writer_lives());
  Value read;
  ASSERT_TRUE(view->read(read));
  EXPECT_EQ(read.words, value_of(42).words);

  const auto entries = list_status_pages(folder_);
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].name, "page");
  EXPECT_EQ(entries[0].pid, pid);
  EXPECT_FALSE(entries[0].writer_lives);
}

TEST_F(StatusPageIn, ReplacesThePageOfADeadWriterUnderTheEyesOfItsReader) {
  Child other([&](const auto& prepared) {
    auto page = create();
    if (!page) return;
    page->publish(value_of(1));
    prepared();
    ::pause();
  });
  ASSERT_TRUE(other.prepared());
  const auto old_view = open();
  ASSERT_TRUE(old_view);
  other.kill();

  auto page = create();
  ASSERT_TRUE(page) << page.error().message;
  page->publish(value_of(2));
  Value read;
  ASSERT_TRUE(old_view->read(read));
  EXPECT_EQ(read.words[0], 1U);
  EXPECT_FALSE(old_view->writer_lives());
  const auto new_view = open();
  ASSERT_TRUE(new_view);
  ASSERT_TRUE(new_view->read(read));
  EXPECT_EQ(read.words[0], 2U);
  EXPECT_TRUE(new_view->writer_lives());
}

TEST_F(StatusPageIn, RefusesTheValueOfAWriterThatDiedWhileWritingIt) {
  Child other([&](const auto& prepared) {
    auto page = StatusPageFile::create(folder_, "page", kLayout, sizeof(Value));
    if (!page) return;
    page->header().sequence = 5;  // as publish() leaves it until the value is whole
    prepared();
    ::pause();
  });
  ASSERT_TRUE(other.prepared());
  other.kill();
  const auto view = open();
  ASSERT_TRUE(view);
  Value read;
  EXPECT_FALSE(view->read(read));
  EXPECT_FALSE(view->writer_lives());
  EXPECT_TRUE(create());
}

TEST_F(StatusPageIn, DoesNotNoticeAReaderThatIsKilledWhileReading) {
  auto page = create();
  ASSERT_TRUE(page);
  page->publish(value_of(0));
  constexpr int kReaders = 5;
  std::uint64_t word = 0;
  for (int i = 0; i < kReaders; ++i) {
    Child reader([&](const auto& prepared) {
      const auto view = open();
      Value read;
      if (!view || !view->read(read)) return;
      prepared();
      for (;;) {  // so that the kill meets it in the middle of a copy
        if (view->read(read) && !is_whole(read)) ::_exit(1);
      }
    });
    ASSERT_TRUE(reader.prepared());
    for (int n = 0; n < 50; ++n) page->publish(value_of(++word));
    EXPECT_EQ(::waitpid(reader.pid(), nullptr, WNOHANG), 0) << "the reader saw a torn value";
    reader.kill();
    for (int n = 0; n < 50; ++n) page->publish(value_of(++word));
  }
  const auto view = open();
  ASSERT_TRUE(view);
  Value read;
  ASSERT_TRUE(view->read(read));
  EXPECT_EQ(read.words, value_of(word).words);
  EXPECT_TRUE(view->writer_lives());
}

TEST_F(StatusPageIn, RefusesNamesThatWouldBePaths) {
  for (const char* name : {"", "../page", "a/b", "a.b", "a b", "\xc3\xa9"}) {
    const auto page = create(name);
    ASSERT_FALSE(page) << name;
    EXPECT_EQ(page.error().code, ErrorCode::kInvalidArgument);
    EXPECT_EQ(open(name).error().code, ErrorCode::kNotFound);
  }
  EXPECT_FALSE(create(std::string(65, 'a')));
  EXPECT_TRUE(create(std::string(64, 'a')));
}

TEST_F(StatusPageIn, RefusesAPageOfAnotherVersion) {
  const auto page = create();
  ASSERT_TRUE(page);
  const auto other_layout = StatusPageView<Value>::open(folder_, "page", kLayout + 1);
  ASSERT_FALSE(other_layout);
  EXPECT_EQ(other_layout.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(other_layout.error().message, HasSubstr("another version"));
  EXPECT_EQ(StatusPageView<std::uint64_t>::open(folder_, "page", kLayout).error().code,
            ErrorCode::kUnsupported);
}

TEST_F(StatusPageIn, RefusesFilesThatAreNoWholePages) {
  std::ofstream(file()) << "something else";
  EXPECT_EQ(open().error().code, ErrorCode::kMalformed);
  StatusPageHeader header{};
  header.magic = StatusPageHeader::kMagic;
  header.layout = kLayout;
  header.value_bytes = sizeof(Value);
  std::ofstream(file()).write(reinterpret_cast<const char*>(&header), sizeof(header));
  EXPECT_EQ(open().error().code, ErrorCode::kMalformed);
  fs::remove(file());
  ASSERT_EQ(::mkfifo(file().c_str(), 0600), 0);
  EXPECT_EQ(open().error().code, ErrorCode::kMalformed);
}

TEST_F(StatusPageIn, FollowsNoSymbolicLink) {
  std::ofstream(folder_ / "victim") << "precious";
  fs::create_symlink(folder_ / "victim", file());
  EXPECT_FALSE(create());
  EXPECT_EQ(fs::file_size(folder_ / "victim"), 8U);
}

TEST_F(StatusPageIn, SaysWhenThereIsNoRoomForIt) {
  const Child other([&](const auto& prepared) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{4096, 4096};
    if (::setrlimit(RLIMIT_FSIZE, &small) != 0) return;
    const auto page = create();
    if (!page && page.error().code == ErrorCode::kWriteFailed && !fs::exists(file())) prepared();
  });
  EXPECT_TRUE(other.prepared());
}

TEST_F(StatusPageIn, SaysWhenItsFolderIsNotThere) {
  const auto page = StatusPage<Value>::create(folder_ / "none", "page", kLayout);
  ASSERT_FALSE(page);
  EXPECT_EQ(page.error().code, ErrorCode::kWriteFailed);
  EXPECT_TRUE(list_status_pages(folder_ / "none").empty());
}

}  // namespace
}  // namespace terracut::rt
