// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/capture/pcap_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <random>

#include "capture_bytes.hpp"
#include "firmware_io/capture/capture_source.hpp"
#include "firmware_io/packet/udp_checksum.hpp"

namespace terracut::capture {
namespace {

using test::Bytes;
using test::ScratchFolder;

packet::Datagram datagram_of(const Bytes& payload,
                             std::int64_t stamp_ns = 1'700'000'000'123'456'789) {
  return {.payload = payload,
          .stamp_ns = stamp_ns,
          .source_address = 0xC0A8032B,
          .destination_address = 0xC0A803FF,
          .source_port = 443,
          .destination_port = 2368};
}

TEST(PcapWriter, WritesWhatTheSourceReadsBack) {
  const ScratchFolder folder;
  std::mt19937 random(1);
  std::vector<Bytes> payloads;
  auto writer = PcapWriter::create(folder / "drive.pcap");
  ASSERT_TRUE(writer) << writer.error().message;
  for (std::size_t i = 0; i < 1000; ++i) {
    Bytes payload(i == 7 ? 0 : random() % 1500);
    for (auto& byte : payload) byte = static_cast<std::uint8_t>(random());
    payloads.push_back(payload);
    ASSERT_TRUE(writer->write(datagram_of(payload, static_cast<std::int64_t>(i) * 288'001)));
  }
  EXPECT_EQ(writer->packets(), 1000U);
  ASSERT_TRUE(writer->finish());
  EXPECT_EQ(folder.files(), 1U);

  auto source = CaptureSource::open(folder / "drive.pcap");
  ASSERT_TRUE(source) << source.error().message;
  for (std::size_t i = 0; i < payloads.size(); ++i) {
    const auto next = source->next();
    ASSERT_TRUE(next && *next);
    EXPECT_THAT((*next)->payload, testing::ElementsAreArray(payloads[i]));
    EXPECT_EQ((*next)->stamp_ns, static_cast<std::int64_t>(i) * 288'001);
    EXPECT_EQ((*next)->source_address, 0xC0A8032BU);
    EXPECT_EQ((*next)->destination_port, 2368);
  }
  const auto end = source->next();
  ASSERT_TRUE(end);
  EXPECT_FALSE(end->has_value());
}

TEST(PcapWriter, PutsRightChecksumsInIpAndUdp) {
  const ScratchFolder folder;
  auto writer = PcapWriter::create(folder / "a.pcap");
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->write(datagram_of({1, 2, 3})));
  ASSERT_TRUE(writer->finish());
  const Bytes file = test::read_file(folder / "a.pcap");
  const std::span ip(file.data() + 24 + 16 + 14, 20);
  // RFC 1071: a header with its checksum in place sums to zero.
  EXPECT_EQ(packet::internet_checksum(ip), 0);
  const std::span udp(file.data() + 24 + 16 + 14 + 20, 8 + 3);
  Bytes pseudo = test::joined({Bytes(ip.begin() + 12, ip.begin() + 20), {0, 17, 0, 11}});
  pseudo.insert(pseudo.end(), udp.begin(), udp.end());
  EXPECT_EQ(packet::internet_checksum(pseudo), 0);
}

TEST(PcapWriter, KnowsTheChecksumOfRfc1071) {
  EXPECT_EQ(packet::internet_checksum(Bytes{0x00, 0x01, 0xF2, 0x03, 0xF4, 0xF5, 0xF6, 0xF7}),
            0x220D);
}

TEST(PcapWriter, LeavesNothingBehindWhenDroppedUnfinished) {
  const ScratchFolder folder;
  test::write_file(folder / "drive.pcap", Bytes{1, 2, 3});
  {
    auto writer = PcapWriter::create(folder / "drive.pcap");
    ASSERT_TRUE(writer);
    ASSERT_TRUE(writer->write(datagram_of(Bytes(1206, 7))));
    EXPECT_EQ(folder.files(), 2U);
  }
  EXPECT_EQ(folder.files(), 1U);
  EXPECT_EQ(test::read_file(folder / "drive.pcap"), (Bytes{1, 2, 3}));
}

TEST(PcapWriter, MovedWritersFinishOnce) {
  const ScratchFolder folder;
  auto first = PcapWriter::create(folder / "a.pcap");
  ASSERT_TRUE(first);
  PcapWriter second = std::move(*first);
  ASSERT_TRUE(second.write(datagram_of(Bytes(5, 7))));
  ASSERT_TRUE(second.finish());
  EXPECT_FALSE(second.finish());
  EXPECT_FALSE(second.write(datagram_of(Bytes(5, 7))));
  EXPECT_EQ(folder.files(), 1U);
}

TEST(PcapWriter, RefusesStampsAndPayloadsThatNoCaptureHolds) {
  const ScratchFolder folder;
  auto writer = PcapWriter::create(folder / "a.pcap");
  ASSERT_TRUE(writer);
  const Bytes payload(5, 7);
  EXPECT_EQ(writer->write(datagram_of(payload, -1)).error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(writer->write(datagram_of(payload, 4'294'967'296'000'000'000)).error().code,
            ErrorCode::kInvalidArgument);
  EXPECT_EQ(writer->write(datagram_of(Bytes(65508, 7))).error().code, ErrorCode::kInvalidArgument);
  EXPECT_TRUE(writer->write(datagram_of(Bytes(65507, 7), 4'294'967'295'999'999'999)));
  EXPECT_TRUE(writer->finish());
  auto source = CaptureSource::open(folder / "a.pcap");
  ASSERT_TRUE(source);
  const auto next = source->next();
  ASSERT_TRUE(next && *next);
  EXPECT_EQ((*next)->payload.size(), 65507U);
  EXPECT_EQ((*next)->stamp_ns, 4'294'967'295'999'999'999);
}

TEST(PcapWriter, SaysWhyItCannotBegin) {
  const ScratchFolder folder;
  test::write_file(folder / "file", Bytes{1});
  const auto under_a_file = PcapWriter::create(folder / "file/drive.pcap");
  ASSERT_FALSE(under_a_file);
  EXPECT_EQ(under_a_file.error().code, ErrorCode::kWriteFailed);
  EXPECT_THAT(under_a_file.error().message, testing::HasSubstr("drive.pcap"));

  const auto a_folder = PcapWriter::create(folder / "");
  ASSERT_FALSE(a_folder);
  EXPECT_EQ(a_folder.error().code, ErrorCode::kInvalidArgument);
  const auto a_device = PcapWriter::create("/dev/null");
  ASSERT_FALSE(a_device);
  EXPECT_EQ(a_device.error().code, ErrorCode::kInvalidArgument);
}

TEST(PcapWriter, MakesMissingFolders) {
  const ScratchFolder folder;
  auto writer = PcapWriter::create(folder / "a/b/drive.pcap");
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->finish());
  EXPECT_TRUE(std::filesystem::exists(folder / "a/b/drive.pcap"));
}

/// Files of this process may not grow beyond `bytes` while this lives: a disk that is full.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    before_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, before_handler_);
  }

 private:
  rlimit before_{};
  void (*before_handler_)(int) = nullptr;
};

TEST(PcapWriter, LeavesNothingBehindOnAFullDisk) {
  const ScratchFolder folder;
  const Bytes payload(1206, 7);
  Status status;
  {
    const FullDisk disk(300'000);
    auto writer = PcapWriter::create(folder / "drive.pcap");
    ASSERT_TRUE(writer);
    for (int i = 0; i < 1000 && status; ++i) status = writer->write(datagram_of(payload));
    ASSERT_FALSE(status);
    EXPECT_FALSE(writer->write(datagram_of(payload)));
    EXPECT_FALSE(writer->finish());
    EXPECT_EQ(folder.files(), 0U);
  }
  EXPECT_EQ(status.error().code, ErrorCode::kWriteFailed);
  EXPECT_THAT(status.error().message, testing::HasSubstr("drive.pcap"));
}

TEST(PcapWriter, FindsAFullDiskInFinishToo) {
  const ScratchFolder folder;
  const FullDisk disk(1'000);
  auto writer = PcapWriter::create(folder / "drive.pcap");
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->write(datagram_of(Bytes(1206, 7))));
  EXPECT_FALSE(writer->finish());
  EXPECT_EQ(folder.files(), 0U);
}

}  // namespace
}  // namespace terracut::capture
