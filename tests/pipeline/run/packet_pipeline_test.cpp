// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "pipeline/run/packet_pipeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "calib/hdl64e/nominal_hdl64e.hpp"
#include "pipeline/ground/segmenter.hpp"
#include "pipeline/ground/stream_segmenter.hpp"
#include "rt/measure/thread_cpu_clock.hpp"
#include "tests/firmware_io/hdl64e/random_drive.hpp"

namespace terracut::run {
namespace {

constexpr int kFrames = 4;

class PacketPipelineTest : public testing::Test {
 protected:
  using Timing = PacketPipeline::Timing;

  std::unique_ptr<PacketPipeline> pipeline(Timing timing = Timing::kPackets) {
    return std::make_unique<PacketPipeline>(unit_, profile_, decode::Decoder::Config{},
                                            ground::turn_maker_of({}), memory_,
                                            PacketPipeline::Makes::kPoints, timing);
  }

  memory::FixedMemory memory_;
  calib::SensorCalibration unit_ = hdl64e::nominal_hdl64e();
  mount::RingProfile profile_ = calib::ring_profile(unit_, mount::Mount{});
  std::vector<test::Packet> packets_ = test::random_packets(
      {.first_cdeg = 0, .last_cdeg = 36'000 * kFrames, .share_of_returns = 0.2});
};

TEST_F(PacketPipelineTest, HandsOutEveryFrameOnceInOrderWithAllItsReturns) {
  const auto way = pipeline();
  std::vector<std::uint32_t> numbers;
  std::uint64_t returns = 0;
  const auto take = [&](const Frame& frame) {
    numbers.push_back(frame.record.info.number);
    EXPECT_EQ(frame.image->returns(), frame.record.info.returns);
    returns += frame.record.info.returns;
  };
  for (const test::Packet& packet : packets_) {
    way->push(packet.datagram());
    while (const Frame* frame = way->next()) take(*frame);
    EXPECT_FALSE(way->rejected());
  }
  way->end_stream();
  while (const Frame* frame = way->next()) take(*frame);
  ASSERT_GE(numbers.size(), static_cast<std::size_t>(kFrames));
  for (std::uint32_t i = 0; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], i);
  test::Recorder decoder_alone(packets_);
  EXPECT_EQ(returns, decoder_alone.returns());
}

TEST_F(PacketPipelineTest, HasALabelForEachReturnAndForAFirstFrameThoseOfItAtOnce) {
  const auto way = pipeline();
  memory::FixedMemory memory;
  ground::Segmenter at_once({}, profile_, way->decoder().shape(), way->decoder().return_capacity(),
                            memory);
  int frames = 0;
  const auto take = [&](const Frame& frame) {
    EXPECT_EQ(way->labels().size(), frame.record.info.returns);
    EXPECT_EQ(frame.record.segmentation.labelled(), frame.record.info.returns);
    if (frames++ > 0) return;
    (void)at_once.segment(*frame.image);
    EXPECT_TRUE(std::ranges::equal(way->labels(), at_once.labels()));
  };
  for (const test::Packet& packet : packets_) {
    way->push(packet.datagram());
    while (const Frame* frame = way->next()) take(*frame);
  }
  way->end_stream();
  while (const Frame* frame = way->next()) take(*frame);
  EXPECT_GE(frames, kFrames);
}

TEST_F(PacketPipelineTest, SaysWhyADatagramWasRejected) {
  const auto way = pipeline();
  const std::vector<std::uint8_t> too_short(100);
  way->push({.payload = too_short});
  EXPECT_EQ(way->next(), nullptr);
  EXPECT_EQ(way->rejected(), frame::Reject::kWrongSize);
}

TEST_F(PacketPipelineTest, TimesOfAFrameAreItsOwn) {
  for (const Timing timing : {Timing::kPackets, Timing::kFrames}) {
    const auto way = pipeline(timing);
    for (const test::Packet& packet : packets_) {
      way->push(packet.datagram());
      while (Frame* frame = way->next()) {
        EXPECT_GE(frame->record.decode_cpu_ns, 0);
        EXPECT_GT(frame->record.stages.sum_ns(), frame->record.ahead_cpu_ns);
        EXPECT_EQ(frame->record.segment_cpu_ns, frame->record.stages.sum_ns());
      }
    }
  }
}

TEST_F(PacketPipelineTest, TimesHoldNothingThatIsDoneBetweenTwoStreams) {
  for (const Timing timing : {Timing::kPackets, Timing::kFrames}) {
    const auto way = pipeline(timing);
    std::int64_t told_ns = 0, spent_ns = 0;
    const auto take = [&](const Frame& frame) {
      told_ns += frame.record.decode_cpu_ns + frame.record.segment_cpu_ns;
    };
    for (int stream = 0; stream < 3; ++stream) {
      test::Recorder something_else;
      something_else.decode_all(packets_);
      const std::int64_t begin_ns = measure::thread_cpu_ns();
      for (const test::Packet& packet : packets_) {
        way->push(packet.datagram());
        while (const Frame* frame = way->next()) take(*frame);
      }
      way->end_stream();
      while (const Frame* frame = way->next()) take(*frame);
      spent_ns += measure::thread_cpu_ns() - begin_ns;
    }
    EXPECT_LE(told_ns, spent_ns);
  }
}

}  // namespace
}  // namespace terracut::run
