// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/status/input_status.hpp"

#include <gmock/gmock.h>

#include <memory>

namespace terracut::status {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kStart_ns = 1'000'000'000'000;

class InputStatusTest : public testing::Test {
 protected:
  /// One more packet `packet_s` after the start; what is said of it at `at_s`.
  std::string hear(double packet_s, double at_s) {
    ++account_.source.received;
    ++account_.source.delivered;
    ++account_.decoded;
    newest_packet_ns_ = kStart_ns + static_cast<std::int64_t>(packet_s * 1e9);
    return look(at_s);
  }
  std::string look(double at_s, net::LinkState link = net::LinkState::kUp) {
    figures_->taken_ns = kStart_ns + static_cast<std::int64_t>(at_s * 1e9);
    return status_.show({.account = account_,
                         .link = link,
                         .newest_packet_ns = newest_packet_ns_,
                         .before_labelling = 3,
                         .blind = blind_},
                        *figures_);
  }

  net::DatagramAccount account_;
  std::int64_t newest_packet_ns_ = 0;
  frame::BlindAzimuths blind_;
  std::unique_ptr<MonitorSnapshot> figures_ = std::make_unique<MonitorSnapshot>();
  InputStatus status_;
};

TEST_F(InputStatusTest, WaitsUntilThePacketsComeAndIsSilentASecondAfterTheLast) {
  EXPECT_EQ(look(5), "");
  EXPECT_EQ(figures_->link, LinkState::kWaiting);
  EXPECT_EQ(figures_->before_labelling, 3U);
  EXPECT_EQ(hear(6, 6), "");
  EXPECT_EQ(figures_->link, LinkState::kReceiving);
  EXPECT_EQ(look(7), "");
  EXPECT_EQ(figures_->link, LinkState::kReceiving);
  EXPECT_THAT(look(7.1), HasSubstr("silent"));
  EXPECT_EQ(figures_->link, LinkState::kSilent);
  EXPECT_EQ(figures_->silences, 1U);
  EXPECT_THAT(hear(8, 8), HasSubstr("heard again"));
}

TEST_F(InputStatusTest, SaysThatTheInterfaceIsGoneOrDownWhateverPacketsThereWere) {
  (void)hear(1, 1);
  EXPECT_THAT(look(1, net::LinkState::kGone), HasSubstr("interface"));
  EXPECT_EQ(figures_->link, LinkState::kInterfaceGone);
  (void)look(1, net::LinkState::kUp);
  EXPECT_EQ(figures_->link, LinkState::kReceiving);
  (void)look(1, net::LinkState::kDown);
  EXPECT_EQ(figures_->link, LinkState::kInterfaceGone);
}

TEST_F(InputStatusTest, SaysThatTheHeadStandsWherePacketsComeThatAllSaySo) {
  (void)hear(1, 1);
  EXPECT_EQ(figures_->head_stands, 0);
  account_.losses.rejected[static_cast<std::size_t>(frame::Reject::kStationary)] = 500;
  EXPECT_THAT(look(1), HasSubstr("head does not rotate"));
  EXPECT_EQ(figures_->head_stands, 1);
  EXPECT_THAT(hear(1.5, 1.5), HasSubstr("rotates again"));
  EXPECT_EQ(figures_->head_stands, 0);
}

TEST_F(InputStatusTest, ShowsWhereEachDatagramWentOfTheNewestLookAlone) {
  account_.source.received = 9;
  account_.source.delivered = 7;
  account_.source.foreign = 2;
  account_.decoded = 6;
  account_.in_doubt = 1;
  (void)look(1);
  (void)look(2);
  std::uint64_t sum = figures_->in_doubt;
  for (const NamedCount& outcome : figures_->outcomes_in_use()) sum += outcome.count;
  EXPECT_EQ(sum, figures_->received);
  EXPECT_EQ(figures_->packets, 7U);
}

TEST_F(InputStatusTest, ShowsTheBlindSector) {
  blind_ = {27'000, 9'000};
  (void)look(1);
  EXPECT_EQ(figures_->blind_from_cdeg, 27'000);
  EXPECT_EQ(figures_->blind_to_cdeg, 9'000);
}

}  // namespace
}  // namespace terracut::status
