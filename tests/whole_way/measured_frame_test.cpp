// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Frames labelled as they were measured, and as images of points: the labels are the same, bit for
// bit, whatever becomes of the packets on their way.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "calib/mount/ring_profile.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "tests/support/hand_out.hpp"
#include "tests/whole_way/simulated_packets.hpp"

namespace terracut::whole_way {
namespace {

using Labels = std::vector<frame::Label>;

struct Labelled {
  std::vector<Labels> frames;
  std::vector<std::vector<std::array<float, 3>>> near_ground;
  std::uint64_t returns = 0, lost = 0;
};

template <class EncoderTraits>
struct MeasuredFrame : testing::Test {
  enum class As { kPoints, kMeasured };

  static simulator::SimulationConfig<EncoderTraits> config(packets::ReturnMode returns) {
    simulator::SimulationConfig<EncoderTraits> config;
    config.scene = "street";
    config.duration_s = 0.25;
    config.threads = 2;
    config.sensor.returns = returns;
    config.mount = {.height_m = 1.9, .roll_rad = 0.02, .pitch_rad = -0.03};
    return config;
  }

  /// As measured they are labelled ahead, while they arrive.
  Labelled labelled(const std::vector<Packet>& packets, const decode::Decoder::Config& decoding,
                    As as) {
    memory::FixedMemory memory;
    decode::Decoder decoder(setup.calibration, setup.mount, decoding, memory);
    frame::PointImage points = decoder.point_image(memory);
    ground::Segmenter segmenter(method, ring_profile(setup.calibration, setup.mount),
                                decoder.shape(), decoder.return_capacity(), memory,
                                as == As::kMeasured ? decoder.make_reader(memory) : nullptr);
    auto near_ground = std::make_unique<ground::NearGround>();
    Labelled made;
    const auto on_frame = [&](const frame::FrameInfo& info,
                              const frame::MeasuredReturns& returns) noexcept {
      const frame::FrameReturns frame = as == As::kMeasured
                                            ? frame::FrameReturns(returns)
                                            : frame::FrameReturns(points.make(returns));
      (void)segmenter.segment(frame);
      made.frames.emplace_back(segmenter.labels().begin(), segmenter.labels().end());
      EXPECT_EQ(made.frames.back().size(), info.returns);
      segmenter.take_near_ground(frame, *near_ground);
      const auto near = near_ground->in_use();
      made.near_ground.emplace_back(near.begin(), near.end());
      made.returns += info.returns;
    };
    for (const Packet& packet : packets) {
      test::decode(decoder, packet.datagram(), on_frame);
      const auto arriving = decoder.arriving();
      if (arriving.returns == nullptr || as == As::kPoints) continue;
      segmenter.advance(*arriving.returns, arriving.complete_columns);
    }
    test::end_stream(decoder, on_frame);
    made.lost = decoder.losses().overflow_full_returns;
    return made;
  }

  void expect_same_labels(const std::vector<Packet>& packets,
                          frame::CellOwner dual_owner = frame::CellOwner::kStrongest) {
    decode::Decoder::Config decoding;
    decoding.dual_owner = dual_owner;
    const Labelled as_points = labelled(packets, decoding, As::kPoints);
    ASSERT_GE(as_points.frames.size(), 2U);
    const Labelled as_measured = labelled(packets, decoding, As::kMeasured);
    ASSERT_EQ(as_measured.frames.size(), as_points.frames.size());
    for (std::size_t i = 0; i < as_points.frames.size(); ++i) {
      EXPECT_TRUE(as_measured.frames[i] == as_points.frames[i]) << "frame " << i;
      EXPECT_TRUE(as_measured.near_ground[i] == as_points.near_ground[i]) << "frame " << i;
    }
    EXPECT_EQ(as_measured.lost, 0U);
  }

  const simulator::SimulationConfig<EncoderTraits> setup = config(packets::ReturnMode::kSingle);
  ground::SegmenterConfig method = ground::terracut_profile();
};

using BothSensors = testing::Types<packets::Hdl64eEncoderTraits, packets::Ruby128EncoderTraits>;
TYPED_TEST_SUITE(MeasuredFrame, BothSensors);

TYPED_TEST(MeasuredFrame, IsLabelledAsOneOfPoints) {
  this->expect_same_labels(simulated_packets(this->setup));
}

TYPED_TEST(MeasuredFrame, IsLabelledAsOneOfPointsInDualReturnWhicheverReturnOwnsACell) {
  const auto packets = simulated_packets(this->config(packets::ReturnMode::kDual));
  for (const auto owner : {frame::CellOwner::kFirstArrived, frame::CellOwner::kStrongest,
                           frame::CellOwner::kNearest, frame::CellOwner::kFarthest}) {
    SCOPED_TRACE(static_cast<int>(owner));
    this->expect_same_labels(packets, owner);
  }
}

TYPED_TEST(MeasuredFrame, IsLabelledAsOneOfPointsByTheCoarseStagesAlone) {
  const auto packets = simulated_packets(this->config(packets::ReturnMode::kDual));
  for (const auto stage : {stage::Stage::kElevationMap, stage::Stage::kAdjacentPoints}) {
    this->method.last_stage = stage;
    this->expect_same_labels(packets);
  }
}

TYPED_TEST(MeasuredFrame, IsLabelledAsOneOfPointsBelowTheRoadSurfaceAndByAHistogram) {
  const auto packets = simulated_packets(this->setup);
  this->method.road.enabled = true;
  this->expect_same_labels(packets);
  this->method = ground::paper_profile();
  this->expect_same_labels(packets);
}

TYPED_TEST(MeasuredFrame, IsLabelledAsOneOfPointsWherePacketsAreLostReorderedOrLate) {
  auto packets = simulated_packets(this->setup);
  for (std::size_t i = 20; i + 3 < packets.size() / 2; i += 17) {
    std::rotate(&packets[i], &packets[i + 1], &packets[i + 3]);  // by as many as is waited for
  }
  for (std::size_t i = packets.size() / 2; i + 45 < packets.size(); i += 60) {
    std::rotate(&packets[i], &packets[i + 1], &packets[i + 40]);  // much too late
  }
  packets.erase(packets.begin() + 100, packets.begin() + 140);
  this->expect_same_labels(packets);
}

TYPED_TEST(MeasuredFrame, IsLabelledAsOneOfPointsAfterTheStreamHasBegunAgain) {
  auto packets = simulated_packets(this->setup);
  const auto again = packets;
  packets.insert(packets.end(), again.begin(), again.end());
  this->expect_same_labels(packets);
}

TYPED_TEST(MeasuredFrame, CountsReturnsThatFoundNoRoom) {
  const auto packets = simulated_packets(this->config(packets::ReturnMode::kDual));
  decode::Decoder::Config decoding;
  const auto whole = this->labelled(packets, decoding, TestFixture::As::kMeasured);
  decoding.returns_per_cell = 1;
  const auto cramped = this->labelled(packets, decoding, TestFixture::As::kMeasured);
  EXPECT_EQ(whole.lost, 0U);
  EXPECT_GT(cramped.lost, whole.returns / 10);
  EXPECT_EQ(cramped.returns + cramped.lost, whole.returns);
}

}  // namespace
}  // namespace terracut::whole_way
