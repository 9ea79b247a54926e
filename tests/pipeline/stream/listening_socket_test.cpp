// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/stream/listening_socket.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/support/scratch_folder.hpp"

namespace terracut::stream {
namespace {

class ListeningSocketTest : public test::InScratchFolder {
 protected:
  void SetUp() override { address_ = {.unix_path = (folder_ / "frames").string()}; }
  StreamAddress address_;
};

TEST_F(ListeningSocketTest, TellsThePortTheSystemChose) {
  const auto socket = ListeningSocket::open({});
  ASSERT_TRUE(socket.has_value());
  EXPECT_NE(socket->address().tcp.port, 0);
  EXPECT_EQ(socket->address().tcp.address, kLoopbackAddress);
}

TEST_F(ListeningSocketTest, ASecondProgramOnTheSamePortIsRefusedByName) {
  const auto first = ListeningSocket::open({});
  ASSERT_TRUE(first.has_value());
  const auto second = ListeningSocket::open(first->address());
  ASSERT_FALSE(second.has_value());
  EXPECT_EQ(second.error().code, ErrorCode::kUnreadable);
  EXPECT_THAT(second.error().message, testing::HasSubstr(to_string(first->address())));
  EXPECT_THAT(second.error().message, testing::HasSubstr("another program has it"));
}

TEST_F(ListeningSocketTest, AnAddressOfAnotherMachineIsRefused) {
  const auto socket = ListeningSocket::open({.tcp = {0xC000'0201, 0}});  // 192.0.2.1, in no network
  ASSERT_FALSE(socket.has_value());
  EXPECT_EQ(socket.error().code, ErrorCode::kNotFound);
}

TEST_F(ListeningSocketTest, AUnixSocketHasTheRightsThatAreAskedForWhateverTheUmask) {
  const auto mode = [&] {
    struct ::stat status{};
    EXPECT_EQ(::lstat(address_.unix_path.c_str(), &status), 0);
    return status.st_mode & 0777U;
  };
  for (const ::mode_t mask : {0022U, 0000U, 0077U}) {
    const ::mode_t before = ::umask(mask);
    {
      const auto usual = ListeningSocket::open(address_);
      ASSERT_TRUE(usual) << usual.error().message;
      EXPECT_EQ(mode(), 0660U);
    }
    for (const ::mode_t wanted : {0600U, 0666U}) {
      const auto socket = ListeningSocket::open(address_, wanted);
      ASSERT_TRUE(socket) << socket.error().message;
      EXPECT_EQ(mode(), wanted);
    }
    ::umask(before);
  }
}

TEST_F(ListeningSocketTest, TheFileOfAUnixSocketGoesWithIt) {
  auto socket = ListeningSocket::open(address_);
  ASSERT_TRUE(socket.has_value()) << socket.error().message;
  EXPECT_TRUE(std::filesystem::is_socket(address_.unix_path));
  {
    const ListeningSocket moved = *std::move(socket);
  }
  EXPECT_FALSE(std::filesystem::exists(address_.unix_path));
}

TEST_F(ListeningSocketTest, AFileThatTookItsPlaceStays) {
  {
    const auto socket = ListeningSocket::open(address_);
    ASSERT_TRUE(socket.has_value());
    std::filesystem::remove(address_.unix_path);
    std::ofstream(address_.unix_path) << "mine";
  }
  EXPECT_TRUE(std::filesystem::is_regular_file(address_.unix_path));
}

TEST_F(ListeningSocketTest, TheFileOfAKilledProcessIsReplaced) {
  const ::pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const auto socket = ListeningSocket::open(address_);
    ::kill(::getpid(), SIGKILL);
  }
  ::waitpid(child, nullptr, 0);
  ASSERT_TRUE(std::filesystem::is_socket(address_.unix_path));
  EXPECT_TRUE(ListeningSocket::open(address_).has_value());
}

TEST_F(ListeningSocketTest, ASocketSomebodyListensOnIsNotTakenAway) {
  const auto first = ListeningSocket::open(address_);
  ASSERT_TRUE(first.has_value());
  const auto second = ListeningSocket::open(address_);
  ASSERT_FALSE(second.has_value());
  EXPECT_THAT(second.error().message, testing::HasSubstr("another program listens there"));
  EXPECT_TRUE(std::filesystem::is_socket(address_.unix_path));
}

TEST_F(ListeningSocketTest, AFileThatIsNoSocketIsLeftAlone) {
  std::ofstream(address_.unix_path) << "a recording, say";
  const auto socket = ListeningSocket::open(address_);
  ASSERT_FALSE(socket.has_value());
  EXPECT_THAT(socket.error().message, testing::HasSubstr("a file that is no socket"));
  EXPECT_EQ(std::filesystem::file_size(address_.unix_path), 16U);
}

TEST_F(ListeningSocketTest, AFolderThatIsNotThereIsNamed) {
  const auto socket = ListeningSocket::open({.unix_path = (folder_ / "none" / "frames").string()});
  ASSERT_FALSE(socket.has_value());
  EXPECT_EQ(socket.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(socket.error().message, testing::HasSubstr("its folder has to be there"));
}

}  // namespace
}  // namespace terracut::stream
