// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
// The whole way: packets of a simulated sensor, a fault script, the loopback interface, the
// decoder. What the receiver counts must be what the script says it did, to the packet.

#include "tests/firmware_io/hdl64e/random_drive.hpp"
#include "tests/firmware_io/net/wire.hpp"
#include "tests/support/hand_out.hpp"
#include "tools/lab/send/device_stamp_shift.hpp"
#include "tools/lab/send/fault_injector.hpp"
#include "tools/lab/send/packet_pacer.hpp"

namespace terracut::test {
namespace {

using frame::Reject;
using send::FaultInjector;

class FaultsToDecoder : public LiveTest {
 protected:
  struct Result {
    std::vector<send::FaultOutcome> outcomes;
    net::ReceiveCounters received;
    frame::LossCounters losses;
    std::uint64_t packets = 0;  ///< Of the sensor, before the faults.
    std::uint64_t frames = 0;
  };

  /// Four frames in 0.4 s, at the sensor's own speed; foreign packets come from another address.
  Result play(const std::string& script) {
    auto source = open({.sender = net::Sender{kLocalhost}});
    auto sensor = sender_to(source);
    auto stranger = sender_to(source, kOtherLocalhost);
    send::PacketPacer pacer(1, memory_);
    FaultInjector injector(
        *send::parse_fault_script(script),
        [&](const packet::Datagram& datagram, FaultInjector::Origin origin) {
          pacer.add(datagram, origin == FaultInjector::Origin::kForeign ? stranger : sensor);
        },
        send::DeviceStampShift());

    Result result;
    std::vector<Received> received;
    for (const Packet& packet : random_packets({.last_cdeg = 37'100 + 4 * 36'000})) {
      injector.feed(packet.datagram());
      ++result.packets;
      keep(source.receive(0), received);  // so that no buffer can be too small
    }
    injector.finish();
    pacer.flush();

    const std::uint64_t sent = sensor.counters().sent + stranger.counters().sent;
    EXPECT_TRUE(
        receive_until(source, received, [&] { return source.counters().received == sent; }));
    source.refresh_drops();

    decode::Decoder decoder(hdl64e::nominal_hdl64e(), {}, {}, memory_);
    const auto on_frame = [&](const frame::FrameInfo&, const frame::MeasuredReturns&) noexcept {
      ++result.frames;
    };
    for (Received& each : received) {
      each.datagram.payload = each.bytes;
      test::decode(decoder, each.datagram, on_frame);
    }
    test::end_stream(decoder, on_frame);
    result.outcomes.assign(injector.outcomes().begin(), injector.outcomes().end());
    for (const auto& each : result.outcomes) EXPECT_TRUE(each.complete()) << to_string(each.fault);
    result.received = source.counters();
    result.losses = decoder.losses();
    EXPECT_EQ(result.received.kernel_drops, 0U);
    return result;
  }
  static std::uint64_t rejected(const Result& result, Reject reason) {
    return result.losses.rejected[static_cast<std::size_t>(reason)];
  }
};

TEST_F(FaultsToDecoder, WithoutFaultsNothingIsCounted) {
  const Result result = play("");
  EXPECT_EQ(result.received.delivered, result.packets);
  EXPECT_EQ(result.losses.network_gap_packets, 0U);
  EXPECT_EQ(result.losses.rejected_total(), 0U);
  EXPECT_EQ(result.losses.clock_jumps, 0U);
}

TEST_F(FaultsToDecoder, LossesAndPausesAreCountedAsGaps) {
  const Result result = play("loss@0.05s:20 loss@0.2s:1 pause@0.25s:0.02s");
  const std::uint64_t lost =
      result.outcomes[0].packets + result.outcomes[1].packets + result.outcomes[2].packets;
  EXPECT_GT(lost, 80U);
  EXPECT_EQ(result.received.delivered, result.packets - lost);
  EXPECT_EQ(result.losses.network_gap_packets, lost);
  EXPECT_EQ(result.losses.rejected_total(), 0U);
}

TEST_F(FaultsToDecoder, ReorderedAndBurstPacketsAreNotLost) {
  const Result result = play("reorder@0.05s:3 reorder@0.1s:1 burst@0.2s:0.03s");
  EXPECT_EQ(result.received.delivered, result.packets);
  EXPECT_EQ(result.losses.network_gap_packets, 0U);
  EXPECT_EQ(result.losses.rejected_total(), 0U);
  EXPECT_EQ(result.losses.clock_jumps, 0U);
}

TEST_F(FaultsToDecoder, DuplicatesAreRejectedAsRepeated) {
  const Result result = play("duplicate@0.1s:7");
  EXPECT_EQ(result.received.delivered, result.packets + 7);
  EXPECT_EQ(rejected(result, Reject::kRepeated), 7U);
  EXPECT_EQ(result.losses.rejected_total(), 7U);
  EXPECT_EQ(result.losses.network_gap_packets, 0U);
}

TEST_F(FaultsToDecoder, ForeignPacketsAreKeptOutByTheSource) {
  const Result result = play("foreign@0.1s:50");
  EXPECT_EQ(result.received.foreign, 50U);
  EXPECT_EQ(result.received.delivered, result.packets);
  EXPECT_EQ(result.losses.rejected_total(), 0U);
}

TEST_F(FaultsToDecoder, TruncatedPacketsAreRejectedAndMissing) {
  const Result result = play("truncate@0.1s:5");
  EXPECT_EQ(rejected(result, Reject::kWrongSize), 5U);
  EXPECT_EQ(result.losses.rejected_total(), 5U);
  EXPECT_EQ(result.losses.network_gap_packets, 5U)
      << "a cut packet has no stamp to say it was there";
}

TEST_F(FaultsToDecoder, AClockJumpIsCountedOnceAndLosesNothing) {
  const Result result = play("clock@0.2s:+200s");
  EXPECT_EQ(result.losses.clock_jumps, 1U);
  EXPECT_EQ(result.losses.network_gap_packets, 0U);
  EXPECT_EQ(result.losses.rejected_total(), 0U);
}

}  // namespace
}  // namespace terracut::test
