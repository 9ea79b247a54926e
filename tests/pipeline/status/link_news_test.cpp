// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/status/link_news.hpp"

#include <gmock/gmock.h>

#include <memory>

#include "pipeline/status/standing_head.hpp"

namespace terracut::status {
namespace {

using status::LinkState;
using testing::HasSubstr;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

class LinkNewsTest : public testing::Test {
 protected:
  /// What is said `at_s` after the start, when the newest packet is of `packet_s`.
  std::string look(LinkState link, double at_s, double packet_s, bool head_stands = false) {
    figures_->link = link;
    figures_->head_stands = head_stands;
    figures_->taken_ns = 1'000 * kSecond_ns + static_cast<std::int64_t>(at_s * 1e9);
    figures_->last_packet_ns = 1'000 * kSecond_ns + static_cast<std::int64_t>(packet_s * 1e9);
    return news_.look(*figures_);
  }
  [[nodiscard]] double silent_s() const { return static_cast<double>(figures_->silent_ns) * 1e-9; }

  std::unique_ptr<MonitorSnapshot> figures_ = std::make_unique<MonitorSnapshot>();
  LinkNews news_;
};

TEST_F(LinkNewsTest, SaysOnceWhenTheSensorFallsSilentAndOnceWhenItIsBack) {
  EXPECT_EQ(look(LinkState::kReceiving, 1, 1), "");
  EXPECT_EQ(look(LinkState::kSilent, 3.5, 2), "the sensor is silent: no packet for 1.5 s");
  EXPECT_EQ(look(LinkState::kSilent, 4, 2), "");
  EXPECT_EQ(look(LinkState::kReceiving, 9, 9), "the sensor is heard again, after 7.0 s");
  EXPECT_EQ(look(LinkState::kReceiving, 10, 10), "");
}

TEST_F(LinkNewsTest, CountsSilencesAndTheirTime) {
  (void)look(LinkState::kReceiving, 1, 1);
  (void)look(LinkState::kSilent, 3, 2);
  EXPECT_EQ(figures_->silences, 1U);
  EXPECT_DOUBLE_EQ(silent_s(), 1);
  (void)look(LinkState::kInterfaceGone, 4, 2);
  EXPECT_EQ(figures_->silences, 1U) << "the same one";
  EXPECT_DOUBLE_EQ(silent_s(), 2);
  (void)look(LinkState::kReceiving, 6, 6);
  EXPECT_DOUBLE_EQ(silent_s(), 4);
  (void)look(LinkState::kSilent, 10, 8.5);
  EXPECT_EQ(figures_->silences, 2U);
  EXPECT_DOUBLE_EQ(silent_s(), 5.5);
  (void)look(LinkState::kReceiving, 11, 11);
  EXPECT_DOUBLE_EQ(silent_s(), 6.5);
}

TEST_F(LinkNewsTest, SaysThatTheInterfaceIsGone) {
  EXPECT_THAT(look(LinkState::kInterfaceGone, 3, 2), HasSubstr("interface"));
  EXPECT_THAT(look(LinkState::kReceiving, 5, 5), HasSubstr("heard again"));
}

TEST_F(LinkNewsTest, SaysThatTheHeadStandsWhichIsNoSilence) {
  EXPECT_THAT(look(LinkState::kReceiving, 2, 2, true), HasSubstr("head does not rotate"));
  EXPECT_EQ(look(LinkState::kReceiving, 3, 3, true), "");
  EXPECT_EQ(look(LinkState::kReceiving, 12, 12), "the sensor's head rotates again, after 10.0 s");
  EXPECT_EQ(figures_->silences, 0U);
  EXPECT_EQ(figures_->silent_ns, 0);
}

TEST(StandingHeadTest, StandsWhereManyPacketsSaySoAndNoneIsDecoded) {
  StandingHead head;
  net::DatagramAccount account;
  auto& refused = account.losses.rejected[static_cast<std::size_t>(frame::Reject::kStationary)];
  account.decoded = 1000;
  EXPECT_FALSE(head.is_standing(account));
  refused += 499;
  EXPECT_FALSE(head.is_standing(account));
  refused += 1;
  EXPECT_TRUE(head.is_standing(account));
  account.decoded += 1;
  EXPECT_FALSE(head.is_standing(account)) << "it rotates again";
  refused += 499;
  EXPECT_FALSE(head.is_standing(account)) << "counted from there";
}

}  // namespace
}  // namespace terracut::status
