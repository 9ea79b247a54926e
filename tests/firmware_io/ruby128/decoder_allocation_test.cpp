// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include <gtest/gtest.h>

#include <utility>

#include "calib/ruby128/nominal_ruby128.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "random_stream.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/hand_out.hpp"

namespace terracut::ruby128 {
namespace {

class Ruby128DecoderMemory : public testing::TestWithParam<bool> {};

TEST_P(Ruby128DecoderMemory, DecodingAllocatesNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer owns the heap";
  auto packets =
      test::random_packets({.dual = GetParam(), .first_cdeg = 34'800, .last_cdeg = 36'000 * 4});
  packets.erase(packets.begin() + 200, packets.begin() + 210);
  std::swap(packets[300], packets[301]);
  packets[400].bytes.blocks[0].azimuth_cdeg = 36'000;

  memory::FixedMemory memory;
  decode::Decoder decoder(nominal_ruby128(), {}, {}, memory);
  std::uint64_t frames = 0, returns = 0;
  const auto on_frame = [&](const frame::FrameInfo& info, const frame::MeasuredReturns&) noexcept {
    ++frames;
    returns += info.returns;
  };
  const std::size_t planned = memory.total_bytes();
  const std::uint64_t before = test::allocations_of_this_thread();
  for (int loop = 0; loop < 3; ++loop) {
    for (const test::RubyPacket& packet : packets)
      test::decode(decoder, packet.datagram(), on_frame);
  }
  test::end_stream(decoder, on_frame);
  EXPECT_EQ(test::allocations_of_this_thread() - before, 0U);
  EXPECT_EQ(memory.total_bytes(), planned);
  EXPECT_GT(frames, 9U);
  EXPECT_GT(returns, 1'000'000U);
}

INSTANTIATE_TEST_SUITE_P(ReturnMode, Ruby128DecoderMemory, testing::Values(false, true),
                         [](const auto& dual) { return dual.param ? "Dual" : "Single"; });

}  // namespace
}  // namespace terracut::ruby128
