// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/service_notify.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "tests/support/scratch_folder.hpp"

namespace terracut::cli {
namespace {

/// What systemd is to a service: a socket that takes datagrams, and the environment that names it.
class Service : public testing::Test {
 protected:
  void SetUp() override { folder_ = test::make_scratch_folder(); }
  void TearDown() override {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) ::unsetenv(name);
    if (manager_ >= 0) ::close(manager_);
    std::filesystem::remove_all(folder_);
  }

  void listen(const std::string& name) {
    manager_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    ASSERT_LT(name.size(), sizeof address.sun_path);
    std::memcpy(address.sun_path, name.data(), name.size());
    if (name.front() == '@') address.sun_path[0] = '\0';
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    ASSERT_EQ(::bind(manager_, reinterpret_cast<const sockaddr*>(&address), length), 0);
    ::setenv("NOTIFY_SOCKET", name.c_str(), 1);
  }
  /// The next message, or nothing.
  [[nodiscard]] std::string heard() const {
    char bytes[1024];
    const ssize_t size = ::recv(manager_, bytes, sizeof bytes, MSG_DONTWAIT);
    return size < 0 ? std::string() : std::string(bytes, static_cast<std::size_t>(size));
  }

  std::filesystem::path folder_;
  int manager_ = -1;
};

TEST_F(Service, OutsideOfOneNothingIsSaid) {
  const auto notify = ServiceNotify::from_environment();
  ASSERT_TRUE(notify);
  EXPECT_FALSE(notify->connected());
  EXPECT_FALSE(notify->watchdog_ns());
  EXPECT_FALSE(notify->ready("waiting"));
}

TEST_F(Service, SpeaksTheProtocol) {
  listen("/tmp/tc_notify_" + std::to_string(::getpid()));
  const auto notify = ServiceNotify::from_environment();
  ASSERT_TRUE(notify) << notify.error().message;
  EXPECT_TRUE(notify->ready("waiting\nfor the sensor"));
  EXPECT_EQ(heard(), "READY=1\nSTATUS=waiting for the sensor");
  EXPECT_TRUE(notify->status("9.9 frames/s"));
  EXPECT_EQ(heard(), "STATUS=9.9 frames/s");
  EXPECT_TRUE(notify->feed_watchdog());
  EXPECT_EQ(heard(), "WATCHDOG=1");
  EXPECT_TRUE(notify->stopping());
  EXPECT_EQ(heard(), "STOPPING=1");
  EXPECT_TRUE(notify->status(std::string(5000, 'x')));
  EXPECT_EQ(heard(), "STATUS=" + std::string(200, 'x'));
  ::unlink(("/tmp/tc_notify_" + std::to_string(::getpid())).c_str());
}

TEST_F(Service, SpeaksToAnAbstractSocket) {
  listen("@terracut_notify_test_" + std::to_string(::getpid()));
  const auto notify = ServiceNotify::from_environment();
  ASSERT_TRUE(notify) << notify.error().message;
  EXPECT_TRUE(notify->feed_watchdog());
  EXPECT_EQ(heard(), "WATCHDOG=1");
}

TEST_F(Service, AManagerThatIsGoneOrDoesNotListenHoldsNothingUp) {
  listen("@terracut_notify_gone_" + std::to_string(::getpid()));
  const auto notify = ServiceNotify::from_environment();
  ASSERT_TRUE(notify);
  int taken = 0;
  while (taken < 100000 && notify->feed_watchdog()) ++taken;
  EXPECT_GT(taken, 0);
  EXPECT_LT(taken, 100000) << "a full socket refuses instead of waiting";
  ::close(manager_);
  manager_ = -1;
  EXPECT_FALSE(notify->feed_watchdog());
}

TEST_F(Service, RefusesSocketsItCannotReach) {
  for (const std::string& name : {std::string("relative/path"), "/" + std::string(200, 'x')}) {
    ::setenv("NOTIFY_SOCKET", name.c_str(), 1);
    const auto notify = ServiceNotify::from_environment();
    ASSERT_FALSE(notify) << name;
    EXPECT_EQ(notify.error().code, ErrorCode::kInvalidArgument);
  }
  ::setenv("NOTIFY_SOCKET", (folder_ / "n").c_str(), 1);
  const auto absent = ServiceNotify::from_environment();
  ASSERT_FALSE(absent);
  EXPECT_THAT(absent.error().message, testing::HasSubstr("cannot be reached"));
}

TEST_F(Service, KnowsItsWatchdogAndThatOfOthers) {
  listen("@terracut_notify_dog_" + std::to_string(::getpid()));
  const auto watchdog = [] { return ServiceNotify::from_environment()->watchdog_ns(); };
  EXPECT_EQ(watchdog(), std::nullopt);
  ::setenv("WATCHDOG_USEC", "5000000", 1);
  EXPECT_EQ(watchdog(), 5'000'000'000);
  ::setenv("WATCHDOG_PID", std::to_string(::getpid()).c_str(), 1);
  EXPECT_EQ(watchdog(), 5'000'000'000);
  ::setenv("WATCHDOG_PID", "1", 1);
  EXPECT_EQ(watchdog(), std::nullopt) << "the parent's";
  ::unsetenv("WATCHDOG_PID");
  for (const char* nonsense : {"", "0", "-5", "5s", "99999999999999999999"}) {
    ::setenv("WATCHDOG_USEC", nonsense, 1);
    EXPECT_EQ(watchdog(), std::nullopt) << nonsense;
  }
}

TEST(Watchdog, IsFedWhileFramesMeetTheirDeadline) {
  WatchdogRule rule;
  EXPECT_TRUE(rule.may_feed({.packets = 1000, .on_time = 10, .missed = 0}));
  EXPECT_TRUE(rule.may_feed({.packets = 2000, .on_time = 19, .missed = 1})) << "one late frame";
  EXPECT_FALSE(rule.may_feed({.packets = 3000, .on_time = 20, .missed = 10})) << "mostly late";
  EXPECT_FALSE(rule.may_feed({.packets = 4000, .on_time = 20, .missed = 20})) << "all late";
  EXPECT_TRUE(rule.may_feed({.packets = 5000, .on_time = 30, .missed = 20})) << "recovered";
}

TEST(Watchdog, IsNotFedWhenPacketsBecomeNoFrames) {
  WatchdogRule rule;
  EXPECT_TRUE(rule.may_feed({.packets = 1000, .on_time = 10}));
  EXPECT_FALSE(rule.may_feed({.packets = 2000, .on_time = 10}));
}

TEST(Watchdog, IsFedWhileTheSensorIsOff) {
  WatchdogRule rule;
  EXPECT_TRUE(rule.may_feed({}));
  EXPECT_TRUE(rule.may_feed({.packets = 1000, .on_time = 10}));
  EXPECT_TRUE(rule.may_feed({.packets = 1000, .on_time = 10}));
}

}  // namespace
}  // namespace terracut::cli
