// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// What one packet may cost ("Work per packet" of docs/design.md), for everything that a packet can
// say, reduced to what the decoders' core looks at: how far the head has gone on, and the clock.
// HeardStream holds each packet to the bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "heard_stream.hpp"
#include "tests/support/thinned.hpp"

namespace terracut::test {
namespace {

/// How far head and clock go on from the packet before: packets, turns, and nanoseconds beside.
struct Step {
  double packets = 0;
  double turns = 0;
  std::int64_t more_ns = 0;
};
constexpr std::int64_t kHour_ns = 3'600'000'000'000;
constexpr std::array<Step, 7> kOfTheHead{
    {{1, 0}, {0, 0}, {-1, 0}, {3, 0}, {0, 0.3}, {0, 0.5}, {0, -0.3}}};
constexpr std::array<Step, 9> kOfTheClock{{{1, 0},
                                           {0, 0},
                                           {-1, 0},
                                           {3, 0},
                                           {0, 0.5},
                                           {0, 1.5},
                                           {0, 40},
                                           {0, 0, -kHour_ns},
                                           {0, 0, 24 * kHour_ns}}};

template <class Sensor>
class WorkOfAPacket : public testing::Test {
 protected:
  static constexpr std::int64_t kStart_ns = 1'767'229'199'900'000'000;
  static constexpr double kTurn_ns = 1e8;

  void hear(const Step& of_the_head, const Step& of_the_clock) {
    turns_ += of_the_head.packets * kPacket_ns / kTurn_ns + of_the_head.turns + 4;
    turns_ -= std::floor(turns_);
    stamp_ns_ += static_cast<std::int64_t>(of_the_clock.packets * kPacket_ns +
                                           of_the_clock.turns * kTurn_ns) +
                 of_the_clock.more_ns;
    const std::size_t before = stream_.frames.size();
    (void)stream_.hear(head_.packet(360 * turns_, stamp_ns_));
    most_frames_ = std::max(most_frames_, stream_.frames.size() - before);
  }
  void go_on(int packets) {
    for (int n = 0; n < packets; ++n) hear(kOfTheHead[0], kOfTheClock[0]);
  }
  /// Hears every two steps one after the other, each time after `settled` packets of a stream.
  void hear_all_pairs(int settled) {
    for (const Step& head : kOfTheHead) {
      for (const Step& clock : kOfTheClock) {
        for (const Step& next_head : kOfTheHead) {
          for (const Step& next_clock : kOfTheClock) {
            go_on(settled);
            hear(head, clock);
            hear(next_head, next_clock);
            if (HasFailure()) return;
          }
        }
      }
    }
  }

  static inline const double kPacket_ns =
      1e3 * Sensor::firing_us(false) * Sensor::firings_per_packet(false);
  Head<Sensor> head_{.share_of_returns = 0.05};
  HeardStream<Sensor> stream_{HeardStream<Sensor>::hasty()};
  double turns_ = 0;
  std::int64_t stamp_ns_ = kStart_ns;
  std::size_t most_frames_ = 0;  // that one packet ended
};

using EverySensor =
    testing::Types<reference::Hdl64e, reference::Ruby128, reference::Hdl32e, reference::Vls128>;
TYPED_TEST_SUITE(WorkOfAPacket, EverySensor);

TYPED_TEST(WorkOfAPacket, IsBoundedAfterAnyTwoSteps) {
  // At the start, with 31 packets in doubt, and where the stream has gone on for long enough.
  for (const int settled : thinned({0, 1, 31, 33})) this->hear_all_pairs(settled);
  EXPECT_GE(this->most_frames_, 3U) << "nothing came near to the bound";
}

}  // namespace
}  // namespace terracut::test
