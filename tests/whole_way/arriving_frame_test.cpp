// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// A frame segmented while its packets arrive, and the same frame at once: the labels are the same,
// whatever becomes of the packets on their way.
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

/// Bits of what a column holds.
struct ColumnHash {
  std::size_t value = 0;
  ColumnHash(const frame::RangeImage& image, int column) {
    for (int row = 0; row < image.shape().rows; ++row) {
      const std::size_t cell = image.shape().cell(row, column);
      if (!image.has_return(cell)) continue;
      for (const float part : {static_cast<float>(row), image.x_m()[cell], image.y_m()[cell],
                               image.z_m()[cell], image.ground_range_m()[cell]}) {
        value = value * 1'000'003 + std::hash<float>{}(part);
      }
    }
  }
};

template <class EncoderTraits>
struct ArrivingFrame : testing::Test {
  static constexpr double kDuration_s = 0.35;

  static simulator::SimulationConfig<EncoderTraits> config() {
    simulator::SimulationConfig<EncoderTraits> config;
    config.scene = "street";
    config.duration_s = kDuration_s;
    config.threads = 2;
    return config;
  }

  ArrivingFrame()
      : decoder(setup.calibration, setup.mount, {}, memory),
        points(decoder.point_image(memory)),
        ahead(segmenter()),
        at_once(segmenter()) {}

  void SetUp() override {
    sent = simulated_packets(setup);
    ASSERT_GT(sent.size(), 300U);
  }

  std::unique_ptr<ground::Segmenter> segmenter() {
    return std::make_unique<ground::Segmenter>(ground::terracut_profile(), profile, decoder.shape(),
                                               decoder.return_capacity(), memory,
                                               decoder.make_reader(memory));
  }

  /// Decodes `packets`, segments every frame both ways and compares.
  void run(const std::vector<Packet>& packets) {
    const auto on_frame = [&](const frame::FrameInfo& info,
                              const frame::MeasuredReturns& returns) noexcept {
      (void)ahead->segment(returns);
      (void)at_once->segment(returns);
      EXPECT_TRUE(std::ranges::equal(ahead->labels(), at_once->labels())) << info.number;
      EXPECT_EQ(ahead->labels().size(), returns.returns());
      check_complete(points.make(returns));
      ++frames;
      complete += info.complete ? 1 : 0;
    };
    for (const Packet& packet : packets) {
      test::decode(decoder, packet.datagram(), on_frame);
      const auto arriving = decoder.arriving();
      if (arriving.returns == nullptr) continue;
      ahead->advance(*arriving.returns, arriving.complete_columns);
      if (arriving.returns != finalizing) hashes.clear();  // a frame without returns is no frame
      finalizing = arriving.returns;
      most_complete = std::max(most_complete, arriving.complete_columns);
      const auto hashed = static_cast<int>(hashes.size());
      if (hashed >= arriving.complete_columns) continue;
      const frame::RangeImage& image = points.make(*arriving.returns);
      for (int column = hashed; column < arriving.complete_columns; ++column) {
        hashes.emplace_back(image, column);
      }
    }
    test::end_stream(decoder, on_frame);
  }
  /// Counts columns that were said to be complete and changed afterwards.
  void check_complete(const frame::RangeImage& image) {
    for (std::size_t i = 0; i < hashes.size(); ++i) {
      changed += hashes[i].value != ColumnHash(image, static_cast<int>(i)).value ? 1 : 0;
    }
    hashes.clear();
  }

  const simulator::SimulationConfig<EncoderTraits> setup = config();
  std::vector<Packet> sent;
  memory::FixedMemory memory;
  mount::RingProfile profile = ring_profile(setup.calibration, setup.mount);
  decode::Decoder decoder;
  frame::PointImage points;
  std::unique_ptr<ground::Segmenter> ahead, at_once;
  const frame::MeasuredReturns* finalizing = nullptr;  // the oldest open frame
  std::vector<ColumnHash> hashes;                      // of its complete columns
  int frames = 0, complete = 0, most_complete = 0, changed = 0;
};

using BothSensors = testing::Types<packets::Hdl64eEncoderTraits, packets::Ruby128EncoderTraits>;
TYPED_TEST_SUITE(ArrivingFrame, BothSensors);

TYPED_TEST(ArrivingFrame, IsLabelledAsAtOnce) {
  this->run(this->sent);
  EXPECT_GE(this->complete, 3);
  EXPECT_EQ(this->changed, 0) << "what was said to be complete is";
  EXPECT_GT(this->most_complete, this->decoder.shape().columns * 19 / 20);
}

TYPED_TEST(ArrivingFrame, IsLabelledAsAtOnceWherePacketsComeInAnotherOrder) {
  auto packets = this->sent;
  for (std::size_t i = 20; i + 3 < packets.size(); i += 17) {
    std::rotate(&packets[i], &packets[i + 1], &packets[i + 3]);  // by as many as is waited for
  }
  this->run(packets);
  EXPECT_GE(this->complete, 3);
  EXPECT_EQ(this->changed, 0);
}

TYPED_TEST(ArrivingFrame, IsLabelledAsAtOnceWherePacketsComeMuchTooLate) {
  auto packets = this->sent;
  for (std::size_t i = 20; i + 45 < packets.size(); i += 60) {
    std::rotate(&packets[i], &packets[i + 1], &packets[i + 40]);
  }
  this->run(packets);
  EXPECT_GE(this->frames, 3);
}

TYPED_TEST(ArrivingFrame, IsLabelledAsAtOnceWherePacketsAreLost) {
  auto packets = this->sent;
  packets.erase(packets.begin() + 100, packets.begin() + 140);
  this->run(packets);
  EXPECT_GE(this->frames, 3);
  EXPECT_EQ(this->changed, 0);
}

TYPED_TEST(ArrivingFrame, IsLabelledAsAtOnceAfterTheStreamHasBegunAgain) {
  this->run(this->sent);
  this->run(this->sent);
  EXPECT_GE(this->complete, 6);
  EXPECT_EQ(this->changed, 0);
}

}  // namespace
}  // namespace terracut::whole_way
