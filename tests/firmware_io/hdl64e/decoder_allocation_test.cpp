// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gtest/gtest.h>

#include "random_drive.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/hand_out.hpp"

namespace terracut::test {
namespace {

TEST(Hdl64eDecoderMemory, DecodingAllocatesNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "a sanitizer owns the heap";
  auto packets = random_packets({.last_cdeg = 37'100 + 3 * 36'000});
  packets.erase(packets.begin() + 200, packets.begin() + 210);
  std::swap(packets[300], packets[301]);
  packets[400].set_u16(2, 36'000);

  memory::FixedMemory memory;
  decode::Decoder decoder(hdl64e::nominal_hdl64e(), {}, {}, memory);
  std::uint64_t frames = 0, returns = 0;
  const auto on_frame = [&](const frame::FrameInfo& info, const frame::MeasuredReturns&) noexcept {
    ++frames;
    returns += info.returns;
  };
  const std::size_t planned = memory.total_bytes();
  const std::uint64_t before = allocations_of_this_thread();
  for (int loop = 0; loop < 3; ++loop) {
    for (const Packet& packet : packets) test::decode(decoder, packet.datagram(), on_frame);
  }
  test::end_stream(decoder, on_frame);
  EXPECT_EQ(allocations_of_this_thread() - before, 0U);
  EXPECT_EQ(memory.total_bytes(), planned);
  EXPECT_GT(frames, 12U);
  EXPECT_GT(returns, 700'000U);
}

TEST(Hdl64eDecoderMemory, TakingTheMotionOutAllocatesNothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "a sanitizer owns the heap";
  const auto packets = random_packets({.last_cdeg = 37'100 + 3 * 36'000});
  memory::FixedMemory memory;
  vehicle::EgoMotion motion({}, memory);
  decode::Decoder::Config config;
  config.motion = &motion;
  decode::Decoder decoder(hdl64e::nominal_hdl64e(), {}, config, memory);
  std::uint64_t frames = 0, deskewed = 0;
  const auto on_frame = [&](const frame::FrameInfo& info, const frame::MeasuredReturns&) noexcept {
    ++frames;
    deskewed += info.deskew.state == frame::DeskewState::kDone ? 1U : 0U;
  };
  const std::size_t planned = memory.total_bytes();
  const std::uint64_t before = allocations_of_this_thread();
  std::int64_t sampled_ns = 0;
  for (const Packet& packet : packets) {
    const packet::Datagram datagram = packet.datagram();
    if (datagram.stamp_ns - sampled_ns > 10'000'000) {
      sampled_ns = datagram.stamp_ns;
      motion.add({sampled_ns, 20, 0.5});
    }
    test::decode(decoder, datagram, on_frame);
  }
  test::end_stream(decoder, on_frame);
  EXPECT_EQ(allocations_of_this_thread() - before, 0U);
  EXPECT_EQ(memory.total_bytes(), planned);
  EXPECT_GE(frames, 3U);
  EXPECT_EQ(deskewed, frames);
}

TEST(Hdl64eDecoderMemory, TheCounterCounts) {
  if (!allocations_are_counted()) GTEST_SKIP() << "a sanitizer owns the heap";
  const std::uint64_t before = allocations_of_this_thread();
  // A compiler may leave out an allocation that nobody sees: this one is seen.
  static std::unique_ptr<std::array<char, 64>> block;
  block = std::make_unique<std::array<char, 64>>();
  EXPECT_NE(block, nullptr);
  EXPECT_GT(allocations_of_this_thread(), before);
}

}  // namespace
}  // namespace terracut::test
