// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/cli/live/service_notify.hpp"

#include <gmock/gmock.h>

#include <string>

#include "service_manager.hpp"

namespace terracut::cli {
namespace {

TEST_F(Service, OutsideOfOneNothingIsSaid) {
  const auto notify = ServiceNotify::from_environment();
  ASSERT_TRUE(notify);
  EXPECT_FALSE(notify->connected());
  EXPECT_FALSE(notify->watchdog_ns());
  EXPECT_FALSE(notify->ready("waiting"));
}

TEST_F(Service, SpeaksTheProtocol) {
  listen((folder_ / "n").string());
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

}  // namespace
}  // namespace terracut::cli
