// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Streams that no sensor sends, made of packets that one might have sent.
#include <gtest/gtest.h>

#include "heard_stream.hpp"

namespace terracut::test {
namespace {

template <class Sensor>
class CraftedStream : public testing::Test {
 protected:
  static constexpr std::int64_t kStart_ns = 1'767'229'199'900'000'000;
  static constexpr double kDegPerNs = 3'600e-9;  // 10 Hz

  /// The head goes on as time does.
  Payload at(std::int64_t since_start_ns) const {
    return head.packet(static_cast<double>(since_start_ns) * kDegPerNs, kStart_ns + since_start_ns);
  }
  /// Accepted packets a microsecond apart, and between any two of them one that is rejected.
  void stand_still_with_rejections(std::int64_t from_ns) {
    for (std::int64_t n = 0; n < 40; ++n) {
      (void)stream.hear(at(from_ns + 1'000 * n));
      Payload bent = at(from_ns + 1'000 * (n + 1));
      Sensor::set_azimuth(bent.bytes, 1, 40'000);
      EXPECT_EQ(stream.hear(bent), frame::Reject::kAzimuthOutOfRange);
    }
  }
  void expect_a_period_of_the_sensor() {
    const std::int64_t period_ns = stream.decoder.packet_period_ns();
    const double nominal_ns = 1e3 * Sensor::firing_us(false) * Sensor::firings_per_packet(false);
    if (period_ns == 0) return;  // not known yet
    EXPECT_NEAR(static_cast<double>(period_ns), nominal_ns, 0.4 * nominal_ns);
  }

  Head<Sensor> head{.share_of_returns = 1};
  HeardStream<Sensor> stream{HeardStream<Sensor>::hasty()};
};

using EverySensor =
    testing::Types<reference::Hdl64e, reference::Ruby128, reference::Hdl32e, reference::Vls128>;
TYPED_TEST_SUITE(CraftedStream, EverySensor);

TYPED_TEST(CraftedStream, OfStampsAMicrosecondApartDividesByNothing) {
  this->stand_still_with_rejections(0);
  this->expect_a_period_of_the_sensor();
  this->stream.hear_all(this->head.frames(1));
  this->stream.flush();
  EXPECT_EQ(this->stream.packets_unaccounted(), 0);
  EXPECT_EQ(this->stream.returns_handed_over + this->stream.decoder.losses().overflow_full_returns,
            this->stream.decoder.packets_decoded() * TypeParam::kColumns * TypeParam::kLasers);
}

TYPED_TEST(CraftedStream, ThatHasThePeriodMeasuredAnewGetsNoneThatTheSensorHasNot) {
  this->stream.hear_all(this->head.frames(1.5));
  const auto packets = this->head.frames(3);
  const std::int64_t now_ns = packets[packets.size() / 2].stamp_ns - this->kStart_ns;
  constexpr std::int64_t kOffPeriod_ns = 15'000'000;
  for (std::int64_t n = 1; n <= 70; ++n)
    (void)this->stream.hear(this->at(now_ns + n * kOffPeriod_ns));
  this->stand_still_with_rejections(now_ns + 71 * kOffPeriod_ns);
  this->expect_a_period_of_the_sensor();
  this->stream.hear_all(packets);
  this->stream.flush();
  this->expect_a_period_of_the_sensor();
  EXPECT_GT(this->stream.decoder.packet_period_ns(), 0);
  EXPECT_EQ(this->stream.packets_unaccounted(), 0);
  EXPECT_EQ(this->stream.returns_handed_over + this->stream.decoder.losses().overflow_full_returns,
            this->stream.decoder.packets_decoded() * TypeParam::kColumns * TypeParam::kLasers);
}

TYPED_TEST(CraftedStream, CannotDrawThePeriodAwayStepByStep) {
  std::int64_t time_ns = 0;
  double period_ns = 1e3 * TypeParam::firing_us(false) * TypeParam::firings_per_packet(false);
  for (int n = 0; n < 20'000; ++n) {
    // Always as short as still passes for a period.
    if (n > 30 && this->stream.decoder.packet_period_ns() > 0) {
      period_ns = 0.89 * static_cast<double>(this->stream.decoder.packet_period_ns());
    }
    time_ns += static_cast<std::int64_t>(period_ns);
    (void)this->stream.hear(this->at(time_ns));
    if (n % 100 == 0) this->expect_a_period_of_the_sensor();
  }
  this->expect_a_period_of_the_sensor();
}

}  // namespace
}  // namespace terracut::test
