// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/dds/participant.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

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

}  // namespace
}  // namespace terracut::dds
