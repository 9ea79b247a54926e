// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/capture/capture_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "capture_bytes.hpp"
#include "tests/support/allocation_counter.hpp"

namespace terracut::capture {
namespace {

using test::Bytes;
using test::CaptureFile;
using test::ethernet;
using test::IpFrame;
using test::little32;
using testing::HasSubstr;

/// Reads to the end; stops at an error.
std::vector<Bytes> payloads_of(CaptureSource& source, std::optional<Error>* error = nullptr) {
  std::vector<Bytes> payloads;
  while (true) {
    auto next = source.next();
    if (!next) {
      if (error != nullptr) *error = next.error();
      return payloads;
    }
    if (!*next) return payloads;
    payloads.emplace_back((*next)->payload.begin(), (*next)->payload.end());
  }
}

IpFrame frame_to(std::uint16_t port, Bytes source = {192, 168, 3, 43}) {
  IpFrame frame;
  frame.destination_port = port;
  frame.source = std::move(source);
  return frame;
}

std::uint64_t refused(const CaptureSource& source, packet::FrameReject reason) {
  return source.counters().refused[static_cast<std::size_t>(reason)];
}

TEST(CaptureSource, CountsEveryFrameByWhatBecameOfIt) {
  IpFrame fragment;
  fragment.fragment_field = 0x2000;
  CaptureFile file;
  file.add(ethernet(frame_to(2368).bytes()))
      .add(ethernet(frame_to(8308).bytes()))
      .add(ethernet(frame_to(2368, {10, 0, 0, 9}).bytes()))
      .add(ethernet(fragment.bytes()))
      .add(ethernet(Bytes(28, 0), 0x0806))
      .add(ethernet(IpFrame{}.bytes()), 40)
      .add(ethernet(frame_to(2368).bytes()));
  auto source = CaptureSource::open_memory(file.bytes(), "memory",
                                           {.port = 2368, .source_address = 0xC0A8032B});
  ASSERT_TRUE(source) << source.error().message;
  EXPECT_EQ(payloads_of(*source).size(), 2U);
  const CaptureCounters& counters = source->counters();
  EXPECT_EQ(counters.frames, 7U);
  EXPECT_EQ(counters.delivered, 2U);
  EXPECT_EQ(counters.other_port, 1U);
  EXPECT_EQ(counters.other_source, 1U);
  EXPECT_EQ(refused(*source, packet::FrameReject::kFragment), 1U);
  EXPECT_EQ(refused(*source, packet::FrameReject::kNotIpv4), 1U);
  EXPECT_EQ(refused(*source, packet::FrameReject::kShortCapture), 1U);
  EXPECT_EQ(counters.refused_total(), 3U);
}

TEST(CaptureSource, CountsWhatTheRestOfItsFilterKeepsOut) {
  IpFrame from_elsewhere;
  from_elsewhere.source_port = 444;
  CaptureFile file;
  file.add(ethernet(IpFrame{}.bytes()))
      .add(ethernet(from_elsewhere.bytes()))
      .add(ethernet(IpFrame{}.bytes(), 0x0800, {0x8100}));
  const auto delivered = [&](CaptureFilter filter) {
    auto source = CaptureSource::open_memory(file.bytes(), "memory", std::move(filter));
    const std::size_t payloads = payloads_of(*source).size();
    EXPECT_EQ(payloads + source->counters().other_stream, 3U);
    EXPECT_EQ(source->counters().frames,
              source->counters().delivered + source->counters().left_out());
    return payloads;
  };
  EXPECT_EQ(delivered({.source_port = 443}), 2U);
  EXPECT_EQ(delivered({.vlan = 0}), 2U);
  EXPECT_EQ(delivered({.vlan = 7}), 1U);
  EXPECT_EQ(delivered({.destination_address = 0xC0A803FF}), 3U);
  EXPECT_EQ(delivered({.destination_address = 1}), 0U);
  EXPECT_EQ(delivered({.source_mac = 0x0202'0202'0202U}), 3U);
  EXPECT_EQ(delivered({.source_mac = 1}), 0U);
  EXPECT_EQ(
      delivered({.is_of_stream = [](const auto& datagram) { return datagram.source_port == 444; }}),
      1U);
}

TEST(CaptureSource, ReadsMicroAndNanosecondStampsInEitherByteOrder) {
  const Bytes frame = ethernet(IpFrame{}.bytes());
  const CaptureFile micro = CaptureFile(1, 0xA1B2C3D4).add(frame);
  const CaptureFile nano = CaptureFile(1, 0xA1B23C4D).add(frame);
  Bytes big = micro.bytes();
  for (const std::ptrdiff_t at : {0, 8, 12, 16, 20, 24, 28, 32, 36}) {
    std::reverse(big.begin() + at, big.begin() + at + 4);
  }
  Bytes first_second = micro.bytes();  // of a clock that nobody set
  std::fill(first_second.begin() + 24, first_second.begin() + 28, std::uint8_t{0});
  std::swap(big[4], big[5]);
  std::swap(big[6], big[7]);
  const std::pair<Bytes, std::int64_t> cases[] = {{micro.bytes(), 1'001'000'250'000},
                                                  {nano.bytes(), 1'001'000'000'250},
                                                  {big, 1'001'000'250'000},
                                                  {first_second, 250'000}};
  for (const auto& [bytes, stamp_ns] : cases) {
    auto source = CaptureSource::open_memory(bytes, "memory");
    ASSERT_TRUE(source) << source.error().message;
    const auto next = source->next();
    ASSERT_TRUE(next && *next);
    EXPECT_EQ((*next)->stamp_ns, stamp_ns);
  }
}

TEST(CaptureSource, AllocatesNothingAPacket) {
  if (!test::allocations_are_counted()) GTEST_SKIP() << "a sanitizer replaces the allocator";
  CaptureFile file;
  for (int i = 0; i < 100; ++i) {
    file.add(ethernet(IpFrame{}.bytes())).add(ethernet(Bytes(28, 0), 0x0806));
  }
  auto source = CaptureSource::open_memory(file.bytes(), "memory");
  ASSERT_TRUE(source);
  ASSERT_TRUE(source->next());  // the first read brings stdio's buffer
  const std::uint64_t before = test::allocations_of_this_thread();
  std::uint64_t packets = 1;
  for (auto next = source->next(); next && *next; next = source->next()) ++packets;
  EXPECT_EQ(test::allocations_of_this_thread(), before);
  EXPECT_EQ(packets, 100U);
}

TEST(CaptureSource, BeginsAgainAfterRewind) {
  const test::ScratchFolder folder;
  const CaptureFile file =
      CaptureFile().add(ethernet(IpFrame{}.bytes())).add(ethernet(IpFrame{}.bytes()));
  test::write_file(folder / "a.pcap", file.bytes());
  auto source = CaptureSource::open(folder / "a.pcap");
  ASSERT_TRUE(source);
  EXPECT_EQ(payloads_of(*source).size(), 2U);
  EXPECT_FALSE(source->next()->has_value());
  ASSERT_TRUE(source->rewind());
  EXPECT_EQ(payloads_of(*source).size(), 2U);
  EXPECT_EQ(source->counters().frames, 4U);

  std::filesystem::remove(folder / "a.pcap");
  EXPECT_FALSE(source->rewind());
  EXPECT_FALSE(source->next());
}

TEST(CaptureSource, AHeaderWithoutPacketsIsAnEmptyCapture) {
  auto source = CaptureSource::open_memory(CaptureFile().bytes(), "memory");
  ASSERT_TRUE(source);
  EXPECT_TRUE(payloads_of(*source).empty());
}

TEST(CaptureSource, KeepsWhatCameBeforeAFileBreaksOff) {
  CaptureFile file;
  std::vector<std::size_t> record_ends{file.bytes().size()};
  for (int i = 0; i < 3; ++i) {
    file.add(ethernet(IpFrame{}.bytes()));
    record_ends.push_back(file.bytes().size());
  }
  for (std::size_t size = 0; size <= file.bytes().size(); ++size) {
    const Bytes cut(file.bytes().begin(), file.bytes().begin() + static_cast<std::ptrdiff_t>(size));
    auto source = CaptureSource::open_memory(cut, "cut.pcap");
    if (size < record_ends[0]) {
      ASSERT_FALSE(source) << size;
      EXPECT_EQ(source.error().code, ErrorCode::kMalformed);
      continue;
    }
    ASSERT_TRUE(source) << size;
    const auto whole = static_cast<std::size_t>(
        std::upper_bound(record_ends.begin(), record_ends.end(), size) - record_ends.begin() - 1);
    std::optional<Error> error;
    EXPECT_EQ(payloads_of(*source, &error).size(), whole) << size;
    if (size == record_ends[whole]) {
      EXPECT_FALSE(error);
    } else {
      ASSERT_TRUE(error) << size;
      EXPECT_EQ(error->code, ErrorCode::kMalformed);
      EXPECT_THAT(error->message, HasSubstr("after packet " + std::to_string(whole)));
      EXPECT_THAT(error->message, HasSubstr("cut.pcap"));
      const auto again = source->next();
      ASSERT_FALSE(again);
      EXPECT_EQ(again.error().message, error->message);
    }
  }
}

TEST(CaptureSource, BreaksOffAtARecordOfImpossibleLength) {
  CaptureFile file;
  file.add(ethernet(IpFrame{}.bytes()));
  Bytes bytes = test::joined({file.bytes(), little32(1), little32(2), little32(0x7FFFFFFF),
                              little32(0x7FFFFFFF), Bytes(100, 0)});
  auto source = CaptureSource::open_memory(bytes, "memory");
  ASSERT_TRUE(source);
  std::optional<Error> error;
  EXPECT_EQ(payloads_of(*source, &error).size(), 1U);
  EXPECT_TRUE(error);
}

TEST(CaptureSource, SaysWhatAFileIsThatIsNoCapture) {
  const test::ScratchFolder folder;
  const auto message_for = [&](std::string_view content) {
    test::write_file(folder / "x", Bytes(content.begin(), content.end()));
    const auto source = CaptureSource::open(folder / "x");
    EXPECT_FALSE(source);
    EXPECT_EQ(source.error().code, ErrorCode::kMalformed);
    return source.error().message;
  };
  EXPECT_THAT(message_for(""), HasSubstr("empty"));
  EXPECT_THAT(message_for("\x1f\x8b\x08 and more bytes than a header needs"), HasSubstr("gunzip"));
  EXPECT_THAT(message_for("#ROSBAG V2.0\nand more bytes than a header"), HasSubstr("ROS bag"));
  EXPECT_THAT(message_for("<?xml version=\"1.0\" and so on and so on ?>"), HasSubstr("XML"));
  EXPECT_THAT(message_for("just a few words of text, with no packet in them"), HasSubstr(": text"));
  EXPECT_THAT(message_for("\x01\x02\x03\x04\x05 bytes of no known kind at all, none"),
              HasSubstr("01 02 03 04"));
  for (const char* cloud : {"# .PCD v0.7 - Point Cloud Data file format", "VERSION .7 and a header",
                            "ply\nformat ascii 1.0 and a header", "ply\r\nformat ascii 1.0"}) {
    EXPECT_THAT(message_for(cloud), HasSubstr("`terracut segment` labels clouds"));
  }
  test::write_file(folder / "000000.bin", Bytes(64, 1));
  EXPECT_THAT(CaptureSource::open(folder / "000000.bin").error().message,
              HasSubstr("A cloud by its name? `terracut segment`"));
}

TEST(CaptureSource, SaysWhyAFileCannotBeOpened) {
  const test::ScratchFolder folder;
  const auto missing = CaptureSource::open(folder / "missing.pcap");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
  EXPECT_THAT(missing.error().message, HasSubstr("missing.pcap"));
  const auto a_folder = CaptureSource::open(folder / ".");
  ASSERT_FALSE(a_folder);
  EXPECT_EQ(a_folder.error().code, ErrorCode::kUnreadable);
  EXPECT_THAT(a_folder.error().message, HasSubstr("folder"));
}

TEST(CaptureSource, RefusesALinkLayerWithoutIpByName) {
  const auto source = CaptureSource::open_memory(CaptureFile(227).bytes(), "can.pcap");
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(source.error().message, HasSubstr("CAN_SOCKETCAN"));
  EXPECT_THAT(source.error().message, HasSubstr("Ethernet"));
}

/// pcapng blocks, little endian.
Bytes block(std::uint32_t type, const Bytes& body) {
  const auto length = static_cast<std::uint32_t>(12 + body.size());
  return test::joined({little32(type), little32(length), body, little32(length)});
}
Bytes section_header() {
  return block(0x0A0D0D0A, test::joined({little32(0x1A2B3C4D), {1, 0, 0, 0}, Bytes(8, 0xFF)}));
}
Bytes interface(std::uint8_t link_type) {
  // Option 9: stamps in nanoseconds.
  return block(
      1,
      test::joined({{link_type, 0, 0, 0}, little32(65535), {9, 0, 1, 0, 9, 0, 0, 0}, little32(0)}));
}
Bytes enhanced_packet(std::uint32_t interface_id, std::uint64_t stamp_ns, const Bytes& frame) {
  const auto size = static_cast<std::uint32_t>(frame.size());
  return block(
      6, test::joined({little32(interface_id), little32(static_cast<std::uint32_t>(stamp_ns >> 32)),
                       little32(static_cast<std::uint32_t>(stamp_ns)), little32(size),
                       little32(size), frame, Bytes((4 - size % 4) % 4, 0)}));
}

TEST(CaptureSource, ReadsPcapngWithNanoseconds) {
  const Bytes file =
      test::joined({section_header(), interface(1),
                    enhanced_packet(0, 1'700'000'000'123'456'789, ethernet(IpFrame{}.bytes()))});
  auto source = CaptureSource::open_memory(file, "a.pcapng");
  ASSERT_TRUE(source) << source.error().message;
  const auto next = source->next();
  ASSERT_TRUE(next && *next);
  EXPECT_EQ((*next)->stamp_ns, 1'700'000'000'123'456'789);
}

TEST(CaptureSource, NamesPcapngWithMixedLinkTypes) {
  const Bytes frame = ethernet(IpFrame{}.bytes());
  const Bytes file = test::joined({section_header(), interface(1), enhanced_packet(0, 1, frame),
                                   interface(113), enhanced_packet(1, 2, frame)});
  auto source = CaptureSource::open_memory(file, "mixed.pcapng");
  ASSERT_TRUE(source) << source.error().message;
  std::optional<Error> error;
  EXPECT_EQ(payloads_of(*source, &error).size(), 1U);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->code, ErrorCode::kUnsupported);
  EXPECT_THAT(error->message, HasSubstr("tshark"));
}

TEST(CaptureSource, HoldsAbsurdPcapngStampsInRange) {
  const Bytes file =
      test::joined({section_header(), interface(1),
                    enhanced_packet(0, ~std::uint64_t{0}, ethernet(IpFrame{}.bytes()))});
  auto source = CaptureSource::open_memory(file, "a.pcapng");
  ASSERT_TRUE(source);
  const auto next = source->next();
  ASSERT_TRUE(next && *next);
  EXPECT_GE((*next)->stamp_ns, 0);
}

TEST(CaptureSource, SurvivesFlippedBitsAndRandomBytes) {
  CaptureFile file;
  for (int i = 0; i < 4; ++i) file.add(ethernet(IpFrame{}.bytes(), 0x0800, {0x8100}));
  std::mt19937 random(7);
  for (int round = 0; round < 20'000; ++round) {
    Bytes bytes = file.bytes();
    if (round % 4 == 0) {
      for (std::size_t i = 24; i < bytes.size(); ++i)
        bytes[i] = static_cast<std::uint8_t>(random());
    }
    for (int flip = 0; flip < 3; ++flip) {
      bytes[random() % bytes.size()] ^= static_cast<std::uint8_t>(1U << (random() % 8));
    }
    auto source = CaptureSource::open_memory(bytes, "memory");
    if (!source) continue;
    payloads_of(*source);
    const CaptureCounters& counters = source->counters();
    ASSERT_EQ(counters.frames, counters.delivered + counters.refused_total());
  }
}

}  // namespace
}  // namespace terracut::capture
