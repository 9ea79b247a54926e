// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/page/status_page_list.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "pipeline/page/status_page.hpp"
#include "tests/support/child_process.hpp"

namespace terracut::page {
namespace {

namespace fs = std::filesystem;

/// In memory, as status pages must be, and of this test alone.
class StatusPageList : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::is_directory("/dev/shm")) GTEST_SKIP() << "there is no /dev/shm";
    folder_ = "/dev/shm/terracut_status_page_list_" + std::to_string(::getpid());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(StatusPageList, NamesPagesOfAnyLayoutWithTheirPublishers) {
  const auto second = StatusPagePublisher<std::uint32_t>::create("second", 7, folder_);
  const auto first = StatusPagePublisher<std::uint64_t>::create("first", 1, folder_);
  ASSERT_TRUE(first && second);
  const auto pages = list_status_pages(folder_);
  ASSERT_EQ(pages.size(), 2U);
  EXPECT_EQ(pages[0].name, "first");
  EXPECT_EQ(pages[1].name, "second");
  EXPECT_EQ(pages[1].pid, ::getpid());
  EXPECT_TRUE(pages[1].publisher_lives);
}

TEST_F(StatusPageList, TellsPagesThatDeadProcessesLeft) {
  const std::string complaint = test::in_child_process([&]() -> std::string {
    const auto page = StatusPagePublisher<int>::create("left", 1, folder_);
    if (page) ::kill(::getpid(), SIGKILL);
    return "the page was not made";
  });
  EXPECT_EQ(complaint, " killed by signal 9");
  const auto pages = list_status_pages(folder_);
  ASSERT_EQ(pages.size(), 1U);
  EXPECT_EQ(pages[0].name, "left");
  EXPECT_FALSE(pages[0].publisher_lives);
}

TEST_F(StatusPageList, LeavesOutHiddenFilesAsThoseOfPagesInTheMaking) {
  const auto page = StatusPagePublisher<int>::create("page", 1, folder_);
  ASSERT_TRUE(page);
  fs::copy_file(page->path(), folder_ / ".copy.terracut");
  const auto pages = list_status_pages(folder_);
  ASSERT_EQ(pages.size(), 1U);
  EXPECT_EQ(pages[0].name, "page");
}

TEST_F(StatusPageList, LeavesOutWhatIsNoPage) {
  std::ofstream(folder_ / "text.terracut") << std::string(500, 'x');
  std::ofstream(folder_ / "short.terracut") << "x";
  std::ofstream(folder_ / "other") << "x";
  ASSERT_EQ(::mkfifo((folder_ / "pipe.terracut").c_str(), 0600), 0);
  EXPECT_TRUE(list_status_pages(folder_).empty());
  EXPECT_TRUE(list_status_pages(folder_ / "none").empty());
}

}  // namespace
}  // namespace terracut::page
