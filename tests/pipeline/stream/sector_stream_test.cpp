// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// Sectors for those readers of a FrameStreamServer that ask for them.
#include <gmock/gmock.h>
#include <sys/socket.h>

#include "stream_test_support.hpp"
#include "tests/support/allocation_counter.hpp"

namespace terracut::stream {
namespace {

constexpr std::size_t kFramePoints = 20'000, kSectorPoints = 1000;

class SectorStream : public StreamTest {
 protected:
  void open_with_sectors(FrameStreamConfig config = {}) {
    config.max_points = kFramePoints;
    config.serves_sectors = true;
    open(config);
  }
  /// A reader that has been heard to ask for sectors.
  FrameStreamReader reader_by_sectors(int receive_buffer_bytes = 0) {
    FrameStreamReader reader(join(receive_buffer_bytes));
    reader.ask_for_sectors();
    server().work_round();
    return reader;
  }
  void serve_sector(std::uint32_t number, std::uint32_t first) {
    const auto points = points_of_frame(number, kFramePoints);
    EXPECT_TRUE(
        server().serve(sector_of(number, first, std::span(points).subspan(first, kSectorPoints))));
  }
  void serve_frame(std::uint32_t number) {
    EXPECT_TRUE(server().serve(frame_of(number, points_of_frame(number, kFramePoints))));
  }
};

TEST_P(SectorStream, PutTogetherSectorsAreTheFrameWhoseHeadComesLast) {
  open_with_sectors();
  FrameStreamReader reader = reader_by_sectors();
  std::vector<WirePoint> together;
  ReceivedFrame got;
  for (std::uint32_t first = 0; first < kFramePoints; first += kSectorPoints) {
    serve_sector(4, first);
    ASSERT_TRUE(receive(reader, got).value_or(false));
    EXPECT_EQ(got.header.number, 4U);
    EXPECT_EQ(got.header.flags, kFrameSector);
    EXPECT_EQ(got.header.first_return, together.size());
    together.insert(together.end(), got.points.begin(), got.points.end());
  }
  EXPECT_EQ(together, on_wire(points_of_frame(4, kFramePoints)));
  serve_frame(4);
  ASSERT_TRUE(receive(reader, got).value_or(false));
  EXPECT_EQ(got.header.number, 4U);
  EXPECT_EQ(got.header.flags, kFrameComplete);
  EXPECT_EQ(got.header.first_return, kFramePoints) << "all of it came before";
  EXPECT_TRUE(got.points.empty());
}

TEST_P(SectorStream, WhoDoesNotAskGetsFramesAlone) {
  open_with_sectors();
  FrameStreamReader by_sectors = reader_by_sectors();
  files::OwnedDescriptor chatty = join();
  ::send(chatty.get(), "GET / HTTP/1.1", 14, MSG_NOSIGNAL);
  server().work_round();
  FrameStreamReader by_frames(std::move(chatty));
  serve_sector(0, 0);
  serve_frame(0);
  ReceivedFrame got;
  ASSERT_TRUE(receive(by_frames, got).value_or(false));
  EXPECT_EQ(got.points, on_wire(points_of_frame(0, kFramePoints)));
  EXPECT_EQ(got.header.flags, kFrameComplete);
  EXPECT_EQ(got.header.first_return, 0U);
  ASSERT_TRUE(receive(by_sectors, got).value_or(false));
  EXPECT_EQ(got.points.size(), kSectorPoints);
}

TEST_P(SectorStream, WithoutSectorsWhoAsksGetsFrames) {
  open({.max_points = kFramePoints});
  FrameStreamReader reader = reader_by_sectors();
  serve_frame(0);
  ReceivedFrame got;
  ASSERT_TRUE(receive(reader, got).value_or(false));
  EXPECT_EQ(got.points.size(), kFramePoints);
  EXPECT_EQ(got.header.flags, kFrameComplete);
}

TEST_P(SectorStream, AQuestionMayComeInPieces) {
  open_with_sectors();
  files::OwnedDescriptor slow = join();
  for (const char letter : kSectorsPlease) {
    ::send(slow.get(), &letter, 1, MSG_NOSIGNAL);
    server().work_round();
  }
  FrameStreamReader reader(std::move(slow));
  serve_sector(0, 0);
  ReceivedFrame got;
  ASSERT_TRUE(receive(reader, got).value_or(false));
  EXPECT_EQ(got.header.flags, kFrameSector);
}

TEST_P(SectorStream, SectorsOfABurstWaitInTheSendBuffer) {
  open_with_sectors();
  FrameStreamReader reader = reader_by_sectors();
  for (std::uint32_t first = 0; first < 4 * kSectorPoints; first += kSectorPoints) {
    serve_sector(0, first);
  }
  ReceivedFrame got;
  for (std::uint32_t n = 0; n < 4; ++n) {
    ASSERT_TRUE(receive(reader, got).value_or(false));
    EXPECT_EQ(got.header.first_return, n * kSectorPoints);
  }
  EXPECT_EQ(figures().sectors_missed, 0U);
}

TEST_P(SectorStream, WhatASlowReaderMissesIsCountedAndDelaysNoOther) {
  open_with_sectors({.send_buffer_bytes = 65'536});
  FrameStreamReader slow = reader_by_sectors(16'384);
  FrameStreamReader quick = reader_by_sectors();
  ReceivedFrame got;
  constexpr std::uint32_t kFrames = 20, kSectors = kFramePoints / kSectorPoints;
  for (std::uint32_t number = 0; number < kFrames; ++number) {
    for (std::uint32_t first = 0; first < kFramePoints; first += kSectorPoints) {
      serve_sector(number, first);
      ASSERT_TRUE(receive(quick, got).value_or(false));
    }
    serve_frame(number);
    ASSERT_TRUE(receive(quick, got).value_or(false));
  }
  EXPECT_EQ(got.header.missed, 0U);
  EXPECT_EQ(server().peer(1).sent, kFrames * (kSectors + 1));
  EXPECT_GT(figures().sectors_missed, 0U);
  EXPECT_EQ(figures().missed, 0U) << "no reader of frames";
  // Each message was got before, or is counted in the header of the one that comes now.
  const std::uint64_t served = kFrames * (kSectors + 1);
  std::uint64_t came = 0;
  while (came + server().peer(0).missed < served) {
    ASSERT_TRUE(receive(slow, got).value_or(false));
    EXPECT_EQ(got.points.size(), got.header.points);
    ++came;
  }
  serve_sector(kFrames, 0);
  ASSERT_TRUE(receive(slow, got).value_or(false));
  EXPECT_EQ(got.header.number, kFrames);
  EXPECT_EQ(came + got.header.missed, served);
}

TEST_P(SectorStream, AllocatesNothing) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer brings its own allocator";
  open_with_sectors();
  const FrameStreamReader reader = reader_by_sectors();
  const auto points = points_of_frame(0, kSectorPoints);
  const std::uint64_t before = test::allocations_of_this_thread();
  for (std::uint32_t n = 0; n < 100; ++n) (void)server().serve(sector_of(0, 0, points));
  EXPECT_EQ(test::allocations_of_this_thread(), before);
}

INSTANTIATE_TEST_SUITE_P(On, SectorStream, testing::Values(Transport::kTcp, Transport::kUnix),
                         transport_name);

}  // namespace
}  // namespace terracut::stream
