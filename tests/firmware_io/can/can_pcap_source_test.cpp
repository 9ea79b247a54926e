// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/can/can_pcap_source.hpp"

#include <gmock/gmock.h>

#include <bit>
#include <fstream>
#include <vector>

#include "firmware_io/can/can_recording.hpp"
#include "firmware_io/can/can_wire.hpp"
#include "frames.hpp"
#include "tests/support/scratch_folder.hpp"

namespace terracut::test {
namespace {

using can::CanFrame;
using can::CanIdOrder;
using can::CanPcapSource;
using can::CanReject;
using can::parse_can_wire;
using testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

enum class Link : std::uint32_t { kEthernet = 1, kCooked = 113, kCan = 227, kCooked2 = 276 };

/// A capture as libpcap writes it on this machine, or on one of the other byte order.
class CaptureBytes {
 public:
  explicit CaptureBytes(Link link, bool other_order = false) : other_order_(other_order) {
    word(0xA1B23C4D);  // nanosecond stamps
    word(other_order_ == (std::endian::native == std::endian::little) ? 0x00020004 : 0x00040002);
    word(0);
    word(0);
    word(65535);
    word(static_cast<std::uint32_t>(link));
  }
  void record(std::int64_t stamp_ns, const Bytes& bytes) {
    word(static_cast<std::uint32_t>(stamp_ns / 1'000'000'000));
    word(static_cast<std::uint32_t>(stamp_ns % 1'000'000'000));
    word(static_cast<std::uint32_t>(bytes.size()));
    word(static_cast<std::uint32_t>(bytes.size()));
    all.insert(all.end(), bytes.begin(), bytes.end());
  }
  /// A number of 4 bytes in the recording machine's order.
  [[nodiscard]] Bytes native(std::uint32_t value) const {
    const bool little = (std::endian::native == std::endian::little) != other_order_;
    Bytes bytes;
    for (int i = 0; i < 4; ++i) {
      bytes.push_back(static_cast<std::uint8_t>(value >> (little ? 8 * i : 24 - 8 * i)));
    }
    return bytes;
  }
  Bytes all;

 private:
  void word(std::uint32_t value) {
    const Bytes bytes = native(value);
    all.insert(all.end(), bytes.begin(), bytes.end());
  }
  bool other_order_;
};

Bytes big_endian(std::uint32_t value) {
  return {static_cast<std::uint8_t>(value >> 24), static_cast<std::uint8_t>(value >> 16),
          static_cast<std::uint8_t>(value >> 8), static_cast<std::uint8_t>(value)};
}

Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

Bytes filled_up(Bytes bytes, std::size_t size) {
  bytes.resize(size);
  return bytes;
}

std::vector<CanFrame> read_all(CanPcapSource& source) {
  std::vector<CanFrame> frames;
  for (;;) {
    const auto next = source.next();
    EXPECT_TRUE(next) << next.error().message;
    if (!next || !*next) return frames;
    frames.push_back(**next);
  }
}

TEST(CanPcapSource, ReadsEveryKindOfFrameOfACanInterface) {
  CaptureBytes capture(Link::kCan);
  capture.record(1'000'000'005, big_endian(0x123) + Bytes{2, 0, 0, 0, 0xAA, 0xBB});
  capture.record(2, filled_up(big_endian(0x98FEF100) + Bytes{3, 0, 0, 0, 1, 2, 3}, 16));
  capture.record(3, filled_up(big_endian(0x40000123) + Bytes{8, 0, 0, 0}, 16));
  capture.record(4, filled_up(big_endian(0x20000040) + Bytes{8, 0, 0, 0, 1}, 16));
  capture.record(5, filled_up(big_endian(0x123) + Bytes{12, 0, 0, 0, 1}, 72));  // no FD flag
  capture.record(6, filled_up(big_endian(0x123) + Bytes{1, 5, 0, 0, 9}, 9));    // with it
  auto source = CanPcapSource::open_memory(capture.all, "drive.pcap");
  ASSERT_TRUE(source) << source.error().message;
  const auto frames = read_all(*source);

  ASSERT_EQ(frames.size(), 6U);
  EXPECT_EQ(frames[0], data_frame({0x123, false}, {0xAA, 0xBB}, 1'000'000'005));
  EXPECT_EQ(frames[1], data_frame({0x18FEF100, true}, {1, 2, 3}, 2));
  EXPECT_TRUE(frames[2].remote);
  EXPECT_EQ(frames[2].length, 8);
  EXPECT_TRUE(frames[3].error);
  EXPECT_EQ(frames[3].id.number, 0x40U);
  EXPECT_TRUE(frames[4].fd);
  EXPECT_EQ(frames[4].length, 12);
  EXPECT_TRUE(frames[5].fd);
  EXPECT_TRUE(frames[5].bit_rate_switch);
  EXPECT_EQ(frames[5].payload()[0], 9);
}

TEST(CanPcapSource, ReadsCookedCapturesOfMachinesOfEitherByteOrder) {
  for (const bool other_order : {false, true}) {
    for (const Link link : {Link::kCooked, Link::kCooked2}) {
      CaptureBytes capture(link, other_order);
      const auto header = [&](std::uint8_t protocol) {
        const Bytes at_the_end = filled_up({}, 14) + Bytes{0, protocol};
        const Bytes at_the_begin = filled_up({0, protocol}, 20);
        return link == Link::kCooked ? at_the_end : at_the_begin;
      };
      const Bytes body{1, 0, 0, 0, 0x77, 0, 0, 0, 0, 0, 0, 0};
      capture.record(1, header(0x0C) + capture.native(0x98FEF100) + body);
      capture.record(2, header(0x08) + filled_up({}, 40));  // IPv6, say
      capture.record(3, header(0x0D) + filled_up(capture.native(0x123) + Bytes{1, 4}, 72));
      auto source = CanPcapSource::open_memory(capture.all, "any.pcap");
      ASSERT_TRUE(source) << source.error().message;
      const auto frames = read_all(*source);
      ASSERT_EQ(frames.size(), 2U);
      EXPECT_EQ(frames[0], data_frame({0x18FEF100, true}, {0x77}, 1));
      EXPECT_TRUE(frames[1].fd);
      EXPECT_EQ(frames[1].id.number, 0x123U);
      EXPECT_EQ(source->counters().no_frame, 1U);
    }
  }
}

TEST(CanPcapSource, CountsRecordsThatAreNoFrameAndNamesTheFirst) {
  CaptureBytes capture(Link::kCan);
  capture.record(1, big_endian(0x123) + Bytes{2, 0, 0, 0, 0xAA});              // cut short
  capture.record(2, big_endian(0x123));                                        // no header even
  capture.record(3, filled_up(big_endian(0x123) + Bytes{9, 0, 0, 0}, 17));     // 9 classic bytes
  capture.record(4, filled_up(big_endian(0x800) + Bytes{1, 0, 0, 0}, 16));     // 12 bits of id
  capture.record(5, filled_up(big_endian(0x123) + Bytes{0x80, 0, 4, 0}, 30));  // XL
  capture.record(6, filled_up(big_endian(0x123) + Bytes{1, 0, 0, 0}, 16));
  auto source = CanPcapSource::open_memory(capture.all, "drive.pcap");
  ASSERT_TRUE(source);
  EXPECT_EQ(read_all(*source).size(), 1U);
  EXPECT_EQ(source->counters().records, 6U);
  EXPECT_EQ(source->counters().delivered, 1U);
  EXPECT_EQ(source->counters().malformed, 4U);
  EXPECT_EQ(source->counters().no_frame, 1U);
  EXPECT_THAT(source->first_fault(), HasSubstr("drive.pcap: record 1: it ends before"));
}

TEST(CanPcapSource, RefusesOtherLinkLayersAndSaysWhereAFileBreaksOff) {
  const CaptureBytes ethernet(Link::kEthernet);
  const auto refused = CanPcapSource::open_memory(ethernet.all, "lidar.pcap");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kUnsupported);
  EXPECT_THAT(refused.error().message, HasSubstr("EN10MB"));

  CaptureBytes broken(Link::kCan);
  broken.record(1, filled_up(big_endian(0x123) + Bytes{1, 0, 0, 0}, 16));
  broken.record(2, filled_up(big_endian(0x123) + Bytes{1, 0, 0, 0}, 16));
  broken.all.pop_back();
  auto source = CanPcapSource::open_memory(broken.all, "drive.pcap");
  ASSERT_TRUE(source);
  EXPECT_TRUE(source->next());
  const auto end = source->next();
  ASSERT_FALSE(end);
  EXPECT_THAT(end.error().message, HasSubstr("after packet 1"));
}

TEST(CanRecording, TellsACaptureFromALogByItsFirstBytes) {
  const ScratchFolder folder;
  for (const bool other_order : {false, true}) {
    CaptureBytes capture(Link::kCan, other_order);
    capture.record(1, filled_up(big_endian(0x123) + Bytes{1, 0, 0, 0, 5}, 16));
    std::ofstream(folder / "drive.log", std::ios::binary)
        .write(reinterpret_cast<const char*>(capture.all.data()),
               static_cast<std::streamsize>(capture.all.size()));
    auto recording = can::CanRecording::open(folder / "drive.log", "can0");
    ASSERT_TRUE(recording) << recording.error().message;
    const auto frame = recording->next();
    ASSERT_TRUE(frame && *frame);
    EXPECT_EQ(**frame, data_frame({0x123, false}, {5}, 1));
  }
  const auto missing = can::CanRecording::open(folder / "none.log");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
}

TEST(CanWire, ReadsWhatItWrites) {
  std::mt19937 random(11);
  for (int i = 0; i < 20'000; ++i) {
    CanFrame frame = random_frame(random);
    frame.stamp_ns = 0;
    std::array<std::uint8_t, can::kFdWireBytes> bytes{};
    const std::size_t size = write_can_wire(frame, bytes);
    ASSERT_EQ(size, frame.fd ? 72U : 16U);
    const auto parsed = parse_can_wire(std::span(bytes).first(size), CanIdOrder::kNative);
    ASSERT_TRUE(parsed);
    ASSERT_EQ(*parsed, frame);
  }
}

TEST(CanWire, RefusesWhatIsNoFrameByItsReason) {
  Bytes bytes = filled_up(big_endian(0x123) + Bytes{0x80}, 30);
  EXPECT_EQ(parse_can_wire(bytes, CanIdOrder::kBigEndian).error(), CanReject::kXl);
  bytes = filled_up(big_endian(0x123) + Bytes{65, 4}, 80);
  EXPECT_EQ(parse_can_wire(bytes, CanIdOrder::kBigEndian).error(), CanReject::kLength);
  EXPECT_EQ(parse_can_wire({}, CanIdOrder::kBigEndian).error(), CanReject::kTruncated);
}

}  // namespace
}  // namespace terracut::test
