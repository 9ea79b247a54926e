// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#include "firmware_io/net/packet_ring.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

namespace terracut::test {
namespace {

using net::PacketRing;
using net::PacketRingSize;
using net::PacketWindow;
using packet::Datagram;

/// A datagram that tells its number everywhere: nothing of another one fits in.
class Telltale {
 public:
  explicit Telltale(std::uint64_t n, std::size_t bytes) : bytes_(bytes) { become(n); }

  void become(std::uint64_t n) {
    for (std::size_t i = 0; i < bytes_.size(); ++i) bytes_[i] = byte(n, i);
    datagram_ = {.payload = bytes_,
                 .stamp_ns = static_cast<std::int64_t>(n),
                 .source_address = static_cast<std::uint32_t>(n * 3),
                 .destination_address = static_cast<std::uint32_t>(n * 5),
                 .source_port = static_cast<std::uint16_t>(n * 7),
                 .destination_port = static_cast<std::uint16_t>(n * 11)};
  }
  [[nodiscard]] const Datagram& datagram() const { return datagram_; }

  /// The number a datagram tells, if it tells the same one everywhere.
  [[nodiscard]] static std::optional<std::uint64_t> number_of(const Datagram& datagram) {
    const auto n = static_cast<std::uint64_t>(datagram.stamp_ns);
    for (std::size_t i = 0; i < datagram.payload.size(); ++i) {
      if (datagram.payload[i] != byte(n, i)) return {};
    }
    const bool right = datagram.source_address == static_cast<std::uint32_t>(n * 3) &&
                       datagram.destination_address == static_cast<std::uint32_t>(n * 5) &&
                       datagram.source_port == static_cast<std::uint16_t>(n * 7) &&
                       datagram.destination_port == static_cast<std::uint16_t>(n * 11);
    if (!right) return {};
    return n;
  }

 private:
  static std::uint8_t byte(std::uint64_t n, std::size_t i) {
    return static_cast<std::uint8_t>((n * 0x9E3779B97F4A7C15ULL + i * 0x2545F491ULL) >> 13);
  }

  std::vector<std::uint8_t> bytes_;
  Datagram datagram_;
};

class PacketRingTest : public testing::Test {
 protected:
  /// Adds datagrams first..last-1 of `bytes` each.
  static void add(PacketRing& ring, std::uint64_t first, std::uint64_t last, std::size_t bytes) {
    for (std::uint64_t n = first; n < last; ++n) ring.add(Telltale(n, bytes).datagram());
  }
  /// Numbers of the datagrams in a copy; fails the test when one is not whole.
  std::vector<std::uint64_t> copy(const PacketRing& ring, const PacketRingSize& size) {
    PacketWindow window(size, memory_);
    ring.copy_to(window);
    std::vector<std::uint64_t> numbers;
    for (std::size_t i = 0; i < window.datagrams(); ++i) {
      const auto number = Telltale::number_of(window.datagram(i));
      EXPECT_TRUE(number.has_value()) << "datagram " << i << " is mixed up";
      numbers.push_back(number.value_or(0));
    }
    EXPECT_EQ(window.overwritten(), 0U) << "nobody writes meanwhile";
    return numbers;
  }
  static std::vector<std::uint64_t> range(std::uint64_t first, std::uint64_t last) {
    std::vector<std::uint64_t> numbers;
    for (std::uint64_t n = first; n < last; ++n) numbers.push_back(n);
    return numbers;
  }

  memory::FixedMemory memory_;
};

TEST_F(PacketRingTest, ANewRingHoldsNothing) {
  const PacketRingSize size{4, 4096};
  PacketRing ring(size, memory_);
  EXPECT_TRUE(copy(ring, size).empty());
  EXPECT_EQ(ring.added(), 0U);
}

TEST_F(PacketRingTest, HoldsEverythingUntilItIsFullAndThenTheNewest) {
  const PacketRingSize size{5, 5 * 1208};
  PacketRing ring(size, memory_);
  for (std::uint64_t added = 1; added <= 23; ++added) {
    add(ring, added - 1, added, 1206);
    EXPECT_EQ(copy(ring, size), range(added < 5 ? 0 : added - 5, added)) << added;
  }
  EXPECT_EQ(ring.added(), 23U);
}

TEST_F(PacketRingTest, IsLimitedByItsBytesToo) {
  const PacketRingSize size{100, 4096};  // three of 1248 bytes and a piece
  PacketRing ring(size, memory_);
  add(ring, 0, 50, 1248);
  EXPECT_EQ(copy(ring, size), range(47, 50));
}

TEST_F(PacketRingTest, TakesAnyLengthAndLosesNoByteOfIt) {
  const PacketRingSize size{64, 4096};
  PacketRing ring(size, memory_);
  PacketWindow window(size, memory_);
  for (std::size_t bytes = 0; bytes <= 1500; bytes += 7) {
    ring.add(Telltale(bytes, bytes).datagram());
    ring.copy_to(window);
    const Datagram last = window.datagram(window.datagrams() - 1);
    ASSERT_EQ(last.payload.size(), bytes);
    ASSERT_EQ(Telltale::number_of(last), bytes);
  }
}

TEST_F(PacketRingTest, LeavesOutWhatIsLongerThanItself) {
  const PacketRingSize size{8, 1024};
  PacketRing ring(size, memory_);
  add(ring, 0, 1, 1024);
  add(ring, 1, 2, 1025);
  EXPECT_EQ(copy(ring, size), range(0, 1));
}

/// Rings so small that the writer laps the reader all the time: where the datagrams' places run out
/// first, and where their bytes do.
class SmallPacketRing : public PacketRingTest,
                        public testing::WithParamInterface<PacketRingSize> {};
INSTANTIATE_TEST_SUITE_P(Sizes, SmallPacketRing,
                         testing::Values(PacketRingSize{32, 24 * 1208},
                                         PacketRingSize{256, 8 * 1208}));

TEST_P(SmallPacketRing, WhileOthersAreAddedACopyHoldsOnlyWholeDatagramsInOrder) {
  const PacketRingSize size = GetParam();
  PacketRing ring(size, memory_);
  PacketWindow window(size, memory_);
  std::jthread writer([&](const std::stop_token& stop) {
    std::vector<Telltale> lengths;
    for (const std::size_t bytes : {1206UL, 1248UL, 554UL, 3UL}) lengths.emplace_back(0, bytes);
    for (std::uint64_t n = 0; !stop.stop_requested(); ++n) {
      Telltale& telltale = lengths[n % lengths.size()];
      telltale.become(n);
      ring.add(telltale.datagram());
    }
  });

  std::uint64_t copied = 0, overwritten = 0, copies = 0;
  const auto enough = [&] { return copied > 5'000 && overwritten > 100; };
  while (!enough() && copies < 2'000'000 && !HasFailure()) {
    const std::uint64_t before = ring.added();
    ring.copy_to(window);
    const std::uint64_t after = ring.added();
    ++copies;
    std::optional<std::uint64_t> previous;
    for (std::size_t i = 0; i < window.datagrams(); ++i) {
      const auto number = Telltale::number_of(window.datagram(i));
      ASSERT_TRUE(number.has_value()) << "datagram " << i << " is mixed up";
      if (previous) {
        ASSERT_EQ(*number, *previous + 1) << "only the oldest may be missing";
      }
      previous = number;
    }
    if (previous) {
      ASSERT_LT(*previous, after);
      ASSERT_GE(*previous + 1, before) << "the newest of the moment it began is there";
    }
    ASSERT_LE(window.datagrams() + window.overwritten(), size.datagrams);
    copied += window.datagrams();
    overwritten += window.overwritten();
  }
  EXPECT_TRUE(enough()) << copied << " copied, " << overwritten << " overwritten";
}

TEST(PacketRingSizeTest, HoldsTheSecondsAskedForAndAReserve) {
  const PacketRingSize size = net::packet_ring_size(5, 3472.2, 1206);
  EXPECT_GE(size.datagrams, 17'361U);
  EXPECT_LE(size.datagrams, 20'000U);
  EXPECT_EQ(size.payload_bytes, size.datagrams * 1208);
}

TEST(PacketRingSizeTest, RefusesWhatMakesNoSense) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)net::packet_ring_size(0, 1000, 1206), std::invalid_argument);
  EXPECT_THROW((void)net::packet_ring_size(nan, 1000, 1206), std::invalid_argument);
  EXPECT_THROW((void)net::packet_ring_size(5, -1, 1206), std::invalid_argument);
  EXPECT_THROW((void)net::packet_ring_size(5, 1000, 0), std::invalid_argument);
  EXPECT_THROW((void)net::packet_ring_size(1e9, 1e9, 1206), std::invalid_argument);
  memory::FixedMemory memory;
  EXPECT_THROW(PacketRing({0, 100}, memory), std::invalid_argument);
}

}  // namespace
}  // namespace terracut::test
