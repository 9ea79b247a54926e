// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "agreement.hpp"
#include "firmware_io/decode/decoder.hpp"
#include "rotating_head.hpp"
#include "tests/support/hand_out.hpp"

namespace terracut::reference {

/// What the product's decoder made of a stream, and how that differs from a reference decoder's.
struct Beside {
  std::string difference;  ///< Empty if there is none (first_difference()).
  frame::LossCounters losses;
  std::vector<frame::FrameInfo> frames;
  std::uint64_t returns = 0, decoded = 0;
  bool dual_return = false;
  std::size_t sectors_inside = 0;  ///< Packets decoded on both sides of a blind sector.
};

/// Decodes a stream with both decoders. A packet that one refuses the other must refuse, unless the
/// reference can go on behind a known blind sector. `unwrap(payload, packet)` returns the degrees
/// to add to a packet's azimuths.
template <class Reference, class Unit, class Unwrap>
Beside decode_beside(const std::vector<Payload>& payloads, const Unit& unit,
                     const std::vector<double>& elevations, const decode::Decoder::Config& config,
                     int columns, const Unwrap& unwrap) {
  const mount::Mount mount{.height_m = 1.9, .roll_rad = -0.02, .pitch_rad = 0.04};
  Reference reference(unit);
  ExpectedFrames expected(elevations, mount, columns);
  memory::FixedMemory memory;
  decode::Decoder decoder(unit, mount, config, memory);
  HandedFrames handed;
  Beside both;
  const auto keep = handed.keep();
  const auto on_frame = [&](const frame::FrameInfo& info, const frame::RangeImage& image) noexcept {
    both.frames.push_back(info);
    keep(info, image);
  };
  for (const Payload& payload : payloads) {
    Packet plain = reference.decode(payload.bytes);
    const auto reason = test::decode(
        decoder, packet::Datagram{.payload = payload.bytes, .stamp_ns = payload.stamp_ns},
        on_frame);
    if constexpr (requires { reference.decode(payload.bytes, true); }) {
      if (!reason && plain.refusal == Refusal::kUneven) {
        plain = reference.decode(payload.bytes, true);
        ++both.sectors_inside;
      }
    }
    EXPECT_EQ(reason.has_value(), plain.refusal != Refusal::kNone);
    EXPECT_EQ(as_refusal(reason), plain.refusal);
    if (plain.refusal == Refusal::kNone) expected.add(plain, unwrap(payload, plain));
  }
  both.dual_return = decoder.dual_return();
  test::end_stream(decoder, on_frame);
  both.difference = first_difference(expected, handed, columns);
  both.losses = decoder.losses();
  both.returns = handed.returns();
  both.decoded = decoder.packets_decoded();
  return both;
}

/// The same for a stream whose packets follow each other by less than half a frame.
template <class Reference, class Unit>
Beside decode_beside(const std::vector<Payload>& payloads, const Unit& unit,
                     const std::vector<double>& elevations, int columns) {
  decode::Decoder::Config config;
  config.columns = columns;
  config.returns_per_cell = 4;
  Frames frames;
  return decode_beside<Reference>(
      payloads, unit, elevations, config, columns,
      [&](const Payload&, const Packet& packet) { return frames.unwrap(packet); });
}

/// The same for a sensor of sensors.hpp.
template <class Sensor>
Beside decode_beside(const std::vector<Payload>& payloads, const typename Sensor::Calibration& unit,
                     int columns) {
  return decode_beside<typename Sensor::Reference>(payloads, unit, Sensor::elevations(unit),
                                                   columns);
}

}  // namespace terracut::reference
