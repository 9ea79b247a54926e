// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Run with and without the right to real-time priorities: what is granted is read back from the
// system, what is refused must be explained.
#include "rt/threads/thread_setup.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/child_process.hpp"

namespace terracut::threads {
namespace {

/// What `action` returns, from a thread of its own: a set-up outlives the test otherwise.
template <class Action>
auto in_own_thread(const Action& action) {
  decltype(action()) result{};
  std::thread([&] { result = action(); }).join();
  return result;
}

int some_allowed_core() {
  ::cpu_set_t cores;
  ::sched_getaffinity(0, sizeof cores, &cores);
  for (int core = CPU_SETSIZE - 1; core >= 0; --core) {
    if (CPU_ISSET(static_cast<std::size_t>(core), &cores)) return core;
  }
  return 0;
}

TEST(ThreadSetup, TellsTheCoresAThreadMayRunOn) {
  const std::vector<int> everywhere = allowed_cores();
  ASSERT_FALSE(everywhere.empty());
  EXPECT_TRUE(std::is_sorted(everywhere.begin(), everywhere.end()));
  EXPECT_EQ(everywhere.back(), some_allowed_core());
  const int core = everywhere.front();
  const auto pinned = in_own_thread([core] {
    const auto grants = set_up_this_thread({.name = "pinned", .core = core});
    return grants ? allowed_cores() : std::vector<int>{};
  });
  EXPECT_EQ(pinned, std::vector<int>{core});
}

TEST(ThreadSetup, GivesTheThreadItsName) {
  const auto name = in_own_thread([] {
    const auto grants = set_up_this_thread({.name = "terracut-cut"});
    if (!grants || grants->size() != 1 || !grants->at(0).granted) return std::string("refused");
    char text[16] = {};
    ::pthread_getname_np(::pthread_self(), text, sizeof text);
    return std::string(text);
  });
  EXPECT_EQ(name, "terracut-cut");
}

TEST(ThreadSetup, PinsTheThreadToTheCoreAndNoOther) {
  const int core = some_allowed_core();
  const std::string cores = in_own_thread([core] {
    const auto grants = set_up_this_thread({.name = "pinned", .core = core});
    if (!grants || grants->size() != 2) return std::string("no answer");
    return grants->at(1).granted ? cores_in_force() : to_line(grants->at(1));
  });
  EXPECT_EQ(cores, std::to_string(core));
}

TEST(ThreadSetup, StaysWhereItMayRunWhenTheCoreDoesNotExist) {
  const std::string before = cores_in_force();
  const Grant grant = in_own_thread([] {
    const auto grants = set_up_this_thread({.name = "lost", .core = CPU_SETSIZE - 1});
    return grants ? grants->at(1) : Grant{};
  });
  EXPECT_FALSE(grant.granted);
  EXPECT_EQ(grant.error_number, EINVAL);
  EXPECT_EQ(grant.in_force, "may run on cores " + before);
  EXPECT_THAT(grant.mend, testing::HasSubstr("cpuset"));
}

TEST(ThreadSetup, RunsFifoIfItMayAndElseSaysWhatToDo) {
  const Grant grant = in_own_thread([] {
    const auto grants = set_up_this_thread({.name = "fifo", .priority = 7});
    return grants ? grants->at(1) : Grant{};
  });
  EXPECT_EQ(grant.asked, "SCHED_FIFO priority 7");
  if (grant.granted) {
    EXPECT_EQ(grant.in_force, "runs as SCHED_FIFO priority 7");
  } else {
    EXPECT_EQ(grant.error_number, EPERM);
    EXPECT_EQ(grant.in_force, "runs as SCHED_OTHER");
    EXPECT_THAT(grant.mend, testing::HasSubstr("setcap"));
  }
}

TEST(ThreadSetup, DoesNotPassItsPriorityOnToThreadsItCreates) {
  const std::string scheduling = in_own_thread([] {
    const auto grants = set_up_this_thread({.name = "fifo", .priority = 50});
    if (!grants || !grants->at(1).granted) return std::string("skip");
    return in_own_thread([] { return scheduling_in_force(); });
  });
  if (scheduling == "skip") GTEST_SKIP() << "no right to real-time priorities here";
  EXPECT_EQ(scheduling, "SCHED_OTHER");
}

TEST(ThreadSetup, FallsBackInGoodOrderWithoutRights) {
  EXPECT_EQ(test::in_child_process([]() -> std::string {
              const rlimit none{.rlim_cur = 0, .rlim_max = 0};
              if (::setrlimit(RLIMIT_RTPRIO, &none) != 0) return "setrlimit failed";
              if (!test::give_up_rights()) return "could not give up rights";
              const auto fifo =
                  set_up_this_thread({.name = "fifo", .priority = 50, .core = some_allowed_core()});
              if (!fifo || fifo->size() != 3) return "three answers expected";
              if (!fifo->at(0).granted || !fifo->at(1).granted) return "name and core are free";
              const Grant& grant = fifo->at(2);
              if (grant.granted || grant.error_number != EPERM) return to_line(grant);
              if (grant.in_force != "runs as SCHED_OTHER") return to_line(grant);
              if (grant.mend.find("limits.conf") == std::string::npos) return to_line(grant);
              return all_granted(*fifo) ? "all granted?" : "";
            }),
            "");
}

/// The way of people who want no capabilities on files: a limit granted at login.
TEST(ThreadSetup, NeedsNoMoreThanTheLimitOfPriorities) {
  const std::string complaint = test::in_child_process([]() -> std::string {
    const rlimit limit{.rlim_cur = 20, .rlim_max = 20};
    if (::setrlimit(RLIMIT_RTPRIO, &limit) != 0) return "skip";
    if (!test::give_up_rights()) return "could not give up rights";
    const auto higher = set_up_this_thread({.name = "fifo", .priority = 21});
    if (!higher || higher->at(1).granted) return "21 was granted";
    const auto allowed = set_up_this_thread({.name = "fifo", .priority = 20});
    return allowed && allowed->at(1).granted ? "" : "20 was refused";
  });
  if (complaint == "skip") GTEST_SKIP() << "no right to raise the limit of priorities here";
  EXPECT_EQ(complaint, "");
}

TEST(ThreadSetup, RefusesRequestsThatMakeNoSense) {
  for (const ThreadRequest& request : {
           ThreadRequest{.name = ""},
           ThreadRequest{.name = "sixteen bytes..."},
           ThreadRequest{.name = "fifo", .priority = -1},
           ThreadRequest{.name = "fifo", .priority = 100},
           ThreadRequest{.name = "core", .core = -1},
           ThreadRequest{.name = "core", .core = 1 << 20},
       }) {
    const auto grants = set_up_this_thread(request);
    ASSERT_FALSE(grants.has_value()) << request.name;
    EXPECT_EQ(grants.error().code, ErrorCode::kInvalidArgument);
  }
}

TEST(Grant, IsOneLineForPeople) {
  EXPECT_EQ(to_line({.asked = "core 3 only", .granted = true, .in_force = "runs on 3"}),
            "core 3 only: granted, runs on 3");
  EXPECT_EQ(to_line({.asked = "SCHED_FIFO priority 5",
                     .error_number = EPERM,
                     .in_force = "runs as SCHED_OTHER",
                     .mend = "ask root"}),
            "SCHED_FIFO priority 5: refused (Operation not permitted), runs as SCHED_OTHER; ask "
            "root");
}

}  // namespace
}  // namespace terracut::threads
