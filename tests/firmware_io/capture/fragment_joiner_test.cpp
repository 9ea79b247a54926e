// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/capture/fragment_joiner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "capture_bytes.hpp"
#include "firmware_io/capture/capture_source.hpp"

namespace terracut::capture {
namespace {

using test::Bytes;
using test::CaptureFile;
using test::ethernet;
using test::IpFrame;

constexpr std::size_t kMost = 1480;

/// A datagram as Ethernet carries it: frames of at most 1500 bytes each with an IP header.
std::vector<Bytes> fragments_of(const Bytes& payload, std::uint8_t id) {
  IpFrame whole;
  whole.payload = payload;
  const Bytes packet = whole.bytes();
  std::vector<Bytes> frames;
  for (std::size_t at = 0; at + 20 < packet.size(); at += kMost) {
    const std::size_t bytes = std::min(kMost, packet.size() - 20 - at);
    const bool more = 20 + at + bytes < packet.size();
    Bytes frame(packet.begin(), packet.begin() + 20);
    const Bytes length = test::big16(static_cast<unsigned>(20 + bytes));
    std::ranges::copy(length, frame.begin() + 2);
    frame[5] = id;
    const Bytes field = test::big16(static_cast<unsigned>(at / 8 + (more ? 0x2000 : 0)));
    std::ranges::copy(field, frame.begin() + 6);
    frame.insert(frame.end(), packet.begin() + static_cast<std::ptrdiff_t>(20 + at),
                 packet.begin() + static_cast<std::ptrdiff_t>(20 + at + bytes));
    frames.push_back(ethernet(frame));
  }
  return frames;
}

struct Read {
  std::vector<Bytes> payloads;
  CaptureCounters counters;
};

Read read(const std::vector<Bytes>& frames) {
  CaptureFile file;
  for (const Bytes& frame : frames) file.add(frame);
  auto source = CaptureSource::open_memory(file.bytes(), "memory", {.port = 2368});
  EXPECT_TRUE(source);
  Read read;
  for (auto next = source->next(); next && *next; next = source->next()) {
    read.payloads.emplace_back((*next)->payload.begin(), (*next)->payload.end());
  }
  read.counters = source->counters();
  EXPECT_EQ(read.counters.frames,
            read.counters.delivered + read.counters.joined + read.counters.left_out());
  return read;
}

TEST(FragmentedDatagrams, ArePutTogetherInWhateverOrderTheyCome) {
  const Bytes payload = test::counting(24'832);
  std::vector<Bytes> frames = fragments_of(payload, 7);
  ASSERT_EQ(frames.size(), 17U);
  std::mt19937 random(1);
  for (int order = 0; order < 4; ++order) {
    const Read found = read(frames);
    ASSERT_EQ(found.payloads.size(), 1U);
    EXPECT_EQ(found.payloads[0], payload);
    EXPECT_EQ(found.counters.joined, 16U);
    EXPECT_EQ(found.counters.refused_total(), 0U);
    std::ranges::shuffle(frames, random);
  }
}

/// Reads two datagrams whose fragments come in turn; their IP headers differ in one byte.
void expect_told_apart_by(std::size_t byte_of_header) {
  constexpr std::size_t kEthernet = 14;
  const Bytes one = test::counting(5'000);
  Bytes other = one;
  std::ranges::reverse(other);
  const auto of_one = fragments_of(one, 1);
  auto of_other = fragments_of(other, 1);
  std::vector<Bytes> frames;
  for (std::size_t i = 0; i < of_one.size(); ++i) {
    of_other[i][kEthernet + byte_of_header] ^= 3;
    frames.push_back(of_one[i]);
    frames.push_back(of_other[i]);
  }
  const Read found = read(frames);
  ASSERT_EQ(found.payloads.size(), 2U);
  EXPECT_EQ(found.payloads[0], one);
  EXPECT_EQ(found.payloads[1], other);
}

TEST(FragmentedDatagrams, AreToldApartByTheirNumber) {
  expect_told_apart_by(5);
}

TEST(FragmentedDatagrams, AreToldApartByTheirAddresses) {
  expect_told_apart_by(15);
  expect_told_apart_by(19);
}

TEST(FragmentedDatagrams, WithAMissingPartAreCountedFrameByFrame) {
  std::vector<Bytes> frames = fragments_of(test::counting(8'448), 7);
  frames.erase(frames.begin() + 2);
  const Read found = read(frames);
  EXPECT_TRUE(found.payloads.empty());
  EXPECT_EQ(found.counters.refused[static_cast<std::size_t>(packet::FrameReject::kFragment)], 5U);
}

TEST(FragmentedDatagrams, RepeatedFragmentsDoNoHarm) {
  const Bytes payload = test::counting(8'448);
  std::vector<Bytes> frames = fragments_of(payload, 7);
  frames.insert(frames.begin() + 2, frames[1]);
  const Read found = read(frames);
  ASSERT_EQ(found.payloads.size(), 1U);
  EXPECT_EQ(found.payloads[0], payload);
  EXPECT_EQ(found.counters.refused_total(), 1U);
}

TEST(FragmentedDatagrams, OfWhichTooManyAreOpenGiveUpTheOldest) {
  const Bytes payload = test::counting(3'000);
  std::vector<Bytes> frames;
  for (std::uint8_t id = 0; id < FragmentJoiner::kMostOpen + 1; ++id) {
    frames.push_back(fragments_of(payload, id)[0]);
  }
  for (std::uint8_t id = 1; id < FragmentJoiner::kMostOpen + 1; ++id) {
    const auto rest = fragments_of(payload, id);
    frames.insert(frames.end(), rest.begin() + 1, rest.end());
  }
  const Read found = read(frames);
  EXPECT_EQ(found.payloads.size(), FragmentJoiner::kMostOpen);
  EXPECT_EQ(found.counters.refused_total(), 1U);
}

}  // namespace
}  // namespace terracut::capture
