// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/dds/participant.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

namespace terracut::dds {
namespace {

const int kDomain = 1 + static_cast<int>(::getpid() % 200);

TEST(Participant, OnLoopbackSaysNothing) {
  testing::internal::CaptureStderr();
  EXPECT_TRUE(Participant::open({.domain = kDomain, .interface = "lo"}));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Participant, PassesOnWhatCycloneSaysOfAWrongConfiguration) {
  ::setenv("CYCLONEDDS_URI", "<CycloneDDS><Domain><Nonsense/></Domain></CycloneDDS>", 1);
  testing::internal::CaptureStderr();
  EXPECT_FALSE(Participant::open({.domain = kDomain, .interface = "lo"}));
  EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr("Nonsense"));
  ::unsetenv("CYCLONEDDS_URI");
}

TEST(Participant, IsInTheDomainOfTheEnvironmentWhereNoneIsSet) {
  ::setenv("ROS_DOMAIN_ID", std::to_string(kDomain).c_str(), 1);
  const auto of_environment = Participant::open({.domain = {}, .interface = "lo"});
  ASSERT_TRUE(of_environment) << of_environment.error().message;
  EXPECT_EQ(of_environment->domain(), kDomain);
  for (const char* bad : {"-1", "233", "2x"}) {
    ::setenv("ROS_DOMAIN_ID", bad, 1);
    const auto refused = Participant::open({.domain = {}, .interface = "lo"});
    ASSERT_FALSE(refused) << bad;
    EXPECT_THAT(refused.error().message, testing::HasSubstr("expected 0 to 232"));
  }
  ::unsetenv("ROS_DOMAIN_ID");
}

}  // namespace
}  // namespace terracut::dds
