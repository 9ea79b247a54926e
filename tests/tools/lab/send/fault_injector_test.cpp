// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "tools/lab/send/fault_injector.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>

namespace terracut::test {
namespace {

using packet::Datagram;
using send::FaultInjector;
using send::FaultOutcome;
using testing::ElementsAre;

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::int64_t kStart_ns = 1'700'000'000'000'000'000;

/// Twenty packets, one a millisecond, of 20 bytes: their number and a device clock of 8 bytes.
class FaultInjectorTest : public testing::Test {
 protected:
  /// What was sent, each as "number@milliseconds", with " half" and " clock+N" where it is so;
  /// foreign ones as "foreign@milliseconds".
  std::vector<std::string> sent(const std::string& script, std::uint64_t packets = 20) {
    sent_.clear();
    auto parsed = send::parse_fault_script(script);
    EXPECT_TRUE(parsed) << script;
    injector_.emplace(
        *parsed,
        [this](const Datagram& datagram, FaultInjector::Origin origin) {
          sent_.push_back(text_of(datagram, origin));
        },
        shift);
    for (std::uint64_t i = 0; i < packets; ++i) {
      std::vector<std::uint8_t> payload(20);
      std::memcpy(payload.data(), &i, sizeof i);
      injector_->feed({.payload = payload,
                       .stamp_ns = kStart_ns + static_cast<std::int64_t>(i) * kMillisecond_ns});
    }
    injector_->finish();
    return sent_;
  }
  /// The packets' numbers alone.
  std::vector<int> order(const std::string& script, std::uint64_t packets = 20) {
    std::vector<int> numbers;
    for (const std::string& each : sent(script, packets)) {
      numbers.push_back(each.starts_with("foreign") ? -1 : std::stoi(each));
    }
    return numbers;
  }
  const FaultOutcome& outcome(std::size_t fault = 0) const { return injector_->outcomes()[fault]; }

  static bool shift(std::span<std::uint8_t> payload, std::int64_t shift_ns) {
    std::int64_t clock_ns = 0;
    std::memcpy(&clock_ns, payload.data() + 12, sizeof clock_ns);
    clock_ns += shift_ns;
    std::memcpy(payload.data() + 12, &clock_ns, sizeof clock_ns);
    return payload[0] != 9;  // packet 9 is one whose clock is not known
  }
  static std::string text_of(const Datagram& datagram, FaultInjector::Origin origin) {
    const std::int64_t at_ns = datagram.stamp_ns - kStart_ns;
    const std::string at = "@" + std::to_string(at_ns / kMillisecond_ns);
    if (origin == FaultInjector::Origin::kForeign) {
      EXPECT_EQ(datagram.payload.size(), FaultInjector::kForeignBytes);
      return "foreign" + at;
    }
    std::uint64_t number = 0;
    std::memcpy(&number, datagram.payload.data(), sizeof number);
    std::string text = std::to_string(number) + at;
    if (datagram.payload.size() != 20) {
      EXPECT_EQ(datagram.payload.size(), 10U);
      return text + " half";
    }
    std::int64_t clock_ns = 0;
    std::memcpy(&clock_ns, datagram.payload.data() + 12, sizeof clock_ns);
    if (clock_ns != 0) text += " clock" + std::to_string(clock_ns / kMillisecond_ns);
    return text;
  }

  std::optional<FaultInjector> injector_;
  std::vector<std::string> sent_;
};

TEST_F(FaultInjectorTest, WithoutFaultsPassesEverythingOn) {
  EXPECT_THAT(sent("", 3), ElementsAre("0@0", "1@1", "2@2"));
  EXPECT_TRUE(injector_->outcomes().empty());
  EXPECT_EQ(injector_->fed(), 3U);
}

TEST_F(FaultInjectorTest, LosesPackets) {
  EXPECT_THAT(order("loss@2ms:3", 7), ElementsAre(0, 1, 5, 6));
  EXPECT_EQ(outcome().packets, 3U);
  EXPECT_THAT(outcome().runs, ElementsAre(FaultOutcome::Run{2, 3}));
  EXPECT_TRUE(outcome().complete());
}

TEST_F(FaultInjectorTest, BeginsWithTheFirstPacketAtOrAfterTheTime) {
  EXPECT_THAT(order("loss@1.5ms:1", 4), ElementsAre(0, 1, 3));
  EXPECT_THAT(order("loss@0s:1", 4), ElementsAre(1, 2, 3));
}

TEST_F(FaultInjectorTest, MovesAPacketBehindOthers) {
  EXPECT_THAT(sent("reorder@1ms:2", 6), ElementsAre("0@0", "2@2", "3@3", "1@3", "4@4", "5@5"));
  EXPECT_EQ(outcome().packets, 2U);
  EXPECT_THAT(outcome().runs, ElementsAre(FaultOutcome::Run{1, 1}));
  EXPECT_TRUE(outcome().complete());
}

TEST_F(FaultInjectorTest, MovesAPacketNoFurtherThanTheStreamGoes) {
  EXPECT_THAT(order("reorder@3ms:5", 6), ElementsAre(0, 1, 2, 4, 5, 3));
  EXPECT_EQ(outcome().packets, 2U);
  EXPECT_FALSE(outcome().complete());
}

TEST_F(FaultInjectorTest, MovesSeveralPacketsAtOnce) {
  EXPECT_THAT(order("reorder@1ms:2 reorder@2ms:2", 7), ElementsAre(0, 3, 4, 1, 2, 5, 6));
  EXPECT_THAT(outcome(1).runs, ElementsAre(FaultOutcome::Run{2, 1}));
}

TEST_F(FaultInjectorTest, RepeatsPackets) {
  EXPECT_THAT(order("duplicate@2ms:2", 5), ElementsAre(0, 1, 2, 2, 3, 3, 4));
  EXPECT_EQ(outcome().packets, 2U);
  EXPECT_THAT(outcome().runs, ElementsAre(FaultOutcome::Run{2, 2}));
}

TEST_F(FaultInjectorTest, FallsSilentForATime) {
  EXPECT_THAT(sent("pause@2ms:3ms", 7), ElementsAre("0@0", "1@1", "5@5", "6@6"));
  EXPECT_EQ(outcome().packets, 3U);
  EXPECT_THAT(outcome().runs, ElementsAre(FaultOutcome::Run{2, 3}));
}

TEST_F(FaultInjectorTest, HoldsPacketsBackAndSendsThemAtOnce) {
  EXPECT_THAT(sent("burst@2ms:3ms", 7),
              ElementsAre("0@0", "1@1", "2@5", "3@5", "4@5", "5@5", "6@6"));
  EXPECT_EQ(outcome().packets, 3U);
  EXPECT_THAT(outcome().runs, ElementsAre(FaultOutcome::Run{2, 3}));
}

TEST_F(FaultInjectorTest, SendsABurstThatTheStreamEndsIn) {
  EXPECT_THAT(sent("burst@2ms:3ms", 4), ElementsAre("0@0", "1@1", "2@5", "3@5"));
}

TEST_F(FaultInjectorTest, KeepsTheOrderWhenBurstsOverlap) {
  EXPECT_THAT(sent("burst@1ms:3ms burst@2ms:4ms", 8),
              ElementsAre("0@0", "1@4", "2@6", "3@6", "4@6", "5@6", "6@6", "7@7"));
}

TEST_F(FaultInjectorTest, InsertsForeignPackets) {
  EXPECT_THAT(sent("foreign@2ms:2", 4),
              ElementsAre("0@0", "1@1", "foreign@2", "foreign@2", "2@2", "3@3"));
  EXPECT_EQ(outcome().packets, 2U);
  EXPECT_THAT(outcome().runs, ElementsAre(FaultOutcome::Run{2, 1}));
}

TEST_F(FaultInjectorTest, CutsPacketsInHalf) {
  EXPECT_THAT(sent("truncate@1ms:2", 4), ElementsAre("0@0", "1@1 half", "2@2 half", "3@3"));
  EXPECT_EQ(outcome().packets, 2U);
}

TEST_F(FaultInjectorTest, LetsTheClockJumpAndStayWrong) {
  EXPECT_THAT(sent("clock@1ms:+5ms clock@3ms:-7ms", 5),
              ElementsAre("0@0", "1@1 clock5", "2@2 clock5", "3@3 clock-2", "4@4 clock-2"));
  EXPECT_THAT(outcome(0).runs, ElementsAre(FaultOutcome::Run{1, 4}));
  EXPECT_THAT(outcome(1).runs, ElementsAre(FaultOutcome::Run{3, 2}));
}

TEST_F(FaultInjectorTest, CountsPacketsWhoseClockItDoesNotKnow) {
  EXPECT_EQ(sent("clock@8ms:+5ms", 12).size(), 12U);
  EXPECT_EQ(injector_->unshifted(), 1U);
  EXPECT_THAT(outcome().runs, ElementsAre(FaultOutcome::Run{8, 1}, FaultOutcome::Run{10, 2}));
}

TEST_F(FaultInjectorTest, CountsOnlyPacketsThatAreStillThere) {
  // Packets 2 and 3 are lost; the three that are doubled are the next ones.
  EXPECT_THAT(order("duplicate@2ms:3 loss@2ms:2", 8), ElementsAre(0, 1, 4, 4, 5, 5, 6, 6, 7));
  EXPECT_THAT(outcome(0).runs, ElementsAre(FaultOutcome::Run{4, 3}));
  EXPECT_THAT(outcome(1).runs, ElementsAre(FaultOutcome::Run{2, 2}));
}

TEST_F(FaultInjectorTest, LetsTheSecondOfTwoFaultsOfAKindFollowTheFirst) {
  EXPECT_THAT(order("loss@2ms:2 loss@3ms:2", 8), ElementsAre(0, 1, 6, 7));
  EXPECT_THAT(outcome(0).runs, ElementsAre(FaultOutcome::Run{2, 2}));
  EXPECT_THAT(outcome(1).runs, ElementsAre(FaultOutcome::Run{4, 2}));
}

TEST_F(FaultInjectorTest, SaysThatAFaultNeverCameToItsTimeOrDidTooLittle) {
  sent("loss@2ms:1000 pause@1s:1s clock@1s:+1s");
  EXPECT_EQ(outcome(0).packets, 18U);
  EXPECT_FALSE(outcome(0).complete());
  EXPECT_EQ(outcome(1).packets, 0U);
  EXPECT_FALSE(outcome(1).complete());
  EXPECT_FALSE(outcome(2).complete());
}

TEST_F(FaultInjectorTest, HoldsAllFaultsTogether) {
  sent(
      "loss@2ms:1 reorder@3ms:2 duplicate@5ms:1 pause@7ms:2ms burst@10ms:3ms foreign@11ms:2 "
      "truncate@14ms:1 clock@15ms:+1ms");
  EXPECT_THAT(sent_, ElementsAre("0@0", "1@1", "4@4", "5@5", "5@5", "3@5", "6@6", "9@9", "10@13",
                                 "foreign@13", "foreign@13", "11@13", "12@13", "13@13",
                                 "14@14 half", "15@15 clock1", "16@16 clock1", "17@17 clock1",
                                 "18@18 clock1", "19@19 clock1"));
  for (const FaultOutcome& each : injector_->outcomes()) {
    EXPECT_TRUE(each.complete()) << to_string(each.fault);
  }
}

}  // namespace
}  // namespace terracut::test
