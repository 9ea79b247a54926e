// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Turns labelled while their packets arrive, and each turn at once, closed with itself: but for few
// returns beside the seam the labels are the same, whatever becomes of the packets on their way.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "pipeline/ground/stream_segmenter.hpp"
#include "pipeline/run/labelled_turns.hpp"
#include "tests/whole_way/simulated_packets.hpp"

namespace terracut::whole_way {
namespace {

template <class EncoderTraits>
struct TurnsLabelled : testing::Test {
  static constexpr double kDuration_s = 0.35;

  static simulator::SimulationConfig<EncoderTraits> config(packets::ReturnMode returns) {
    simulator::SimulationConfig<EncoderTraits> config;
    config.scene = "street";
    config.duration_s = kDuration_s;
    config.threads = 2;
    config.sensor.returns = returns;
    return config;
  }

  void simulate(packets::ReturnMode returns = packets::ReturnMode::kSingle) {
    setup = config(returns);
    sent = simulated_packets(setup);
    ASSERT_GT(sent.size(), 300U);
    profile = ring_profile(setup.calibration, setup.mount);
    turns.emplace(setup.calibration, profile, decode::Decoder::Config{},
                  ground::turn_maker_of(ground::terracut_profile()), memory);
    points.emplace(turns->decoder().point_image(memory));
    at_once.emplace(ground::terracut_profile(), profile, turns->decoder().shape(),
                    turns->decoder().return_capacity(), memory);
  }

  void take_turns() {
    while (const frame::Frame* turn = turns->next({}, nullptr)) {
      const std::span<const frame::Label> labels = turns->labels();
      ASSERT_EQ(labels.size(), turn->info.returns);
      EXPECT_EQ(std::ranges::count(labels, frame::Label::kNone), 0);
      const frame::RangeImage& image = points->make(*turn->returns);
      (void)at_once->segment(image);
      for (std::size_t i = 0; i < labels.size(); ++i) {
        differ += labels[i] != at_once->labels()[i] ? 1 : 0;
      }
      returns_labelled += labels.size();
      late += turns->report().late;
      cut_open += turns->report().cut.cut_open;
      ++frames;
      complete += turn->info.complete ? 1 : 0;
    }
  }
  /// Labels every turn while it arrives, and at once.
  void run(const std::vector<Packet>& packets) {
    for (const Packet& packet : packets) {
      turns->push(packet.datagram());
      take_turns();
    }
    turns->end_stream();
    take_turns();
  }
  [[nodiscard]] double share_that_differs() const {
    return static_cast<double>(differ) / static_cast<double>(returns_labelled);
  }

  simulator::SimulationConfig<EncoderTraits> setup;
  std::vector<Packet> sent;
  memory::FixedMemory memory;
  mount::RingProfile profile;
  std::optional<run::LabelledTurns> turns;
  std::optional<frame::PointImage> points;
  std::optional<ground::Segmenter> at_once;
  std::uint64_t returns_labelled = 0, differ = 0, late = 0, cut_open = 0;
  int frames = 0, complete = 0;
};

using BothSensors = testing::Types<packets::Hdl64eEncoderTraits, packets::Ruby128EncoderTraits>;
TYPED_TEST_SUITE(TurnsLabelled, BothSensors);

TYPED_TEST(TurnsLabelled, HaveTheLabelsOfEachAtOnce) {
  this->simulate();
  this->run(this->sent);
  EXPECT_GE(this->complete, 3);
  EXPECT_EQ(this->late, 0U);
  EXPECT_LT(this->share_that_differs(), 0.001);
}

TYPED_TEST(TurnsLabelled, HaveTheLabelsOfEachAtOnceInDualReturn) {
  this->simulate(packets::ReturnMode::kDual);
  this->run(this->sent);
  EXPECT_GE(this->complete, 3);
  EXPECT_EQ(this->late, 0U);
  EXPECT_LT(this->share_that_differs(), 0.001);
}

TYPED_TEST(TurnsLabelled, HaveTheLabelsOfEachAtOnceWherePacketsComeInAnotherOrder) {
  this->simulate();
  auto packets = this->sent;
  for (std::size_t i = 20; i + 3 < packets.size(); i += 17) {
    std::rotate(&packets[i], &packets[i + 1], &packets[i + 3]);  // by as many as is waited for
  }
  this->run(packets);
  EXPECT_GE(this->complete, 3);
  EXPECT_EQ(this->late, 0U) << "what was said to be complete is";
  EXPECT_LT(this->share_that_differs(), 0.001);
}

TYPED_TEST(TurnsLabelled, CountWhatComesMuchTooLate) {
  this->simulate();
  auto packets = this->sent;
  const std::size_t by = packets.size() / 21;  // a sixth of a turn
  for (std::size_t i = 20; i + 2 * by < packets.size(); i += 2 * by) {
    std::rotate(&packets[i], &packets[i + 1], &packets[i + by]);
  }
  this->run(packets);
  EXPECT_GE(this->frames, 3);
  EXPECT_GT(this->late, 0U) << "of what came after its columns were labelled";
  EXPECT_LT(this->share_that_differs(), 0.01);
}

TYPED_TEST(TurnsLabelled, HaveTheLabelsOfEachAtOnceWherePacketsAreLost) {
  this->simulate();
  auto packets = this->sent;
  packets.erase(packets.begin() + 100, packets.begin() + 140);
  this->run(packets);
  EXPECT_GE(this->frames, 3);
  EXPECT_LT(this->share_that_differs(), 0.001);
}

TYPED_TEST(TurnsLabelled, BeginAgainWithTheStream) {
  this->simulate();
  this->run(this->sent);
  const std::uint64_t in_first = this->differ;
  this->run(this->sent);
  EXPECT_GE(this->complete, 6);
  EXPECT_EQ(this->differ, 2 * in_first) << "nothing is left of the stream before";
}

}  // namespace
}  // namespace terracut::whole_way
