// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "calib/ruby128/ruby128_calibration.hpp"
#include "firmware_io/capture/pcap_writer.hpp"
#include "firmware_io/packet/ruby128_wire.hpp"
#include "firmware_io/ruby128/difop.hpp"
#include "rt/error.hpp"
#include "tools/lab/packets/labelled_return.hpp"
#include "tools/lab/packets/ruby128_packet_encoder.hpp"

namespace terracut::packets {

/// The facts that a unit reports beside its measurements.
struct Ruby128Unit {
  std::uint16_t rpm = 600;
  std::array<std::uint8_t, 6> serial{};
  double temperature_deg_c = 41.5;
};

/// Writes an RS-Ruby128's packets into a capture, with the factory's addresses and ports: the data
/// packets (MSOP) that it is given, and the device packet (DIFOP) with the unit's angles, before
/// the first of them and then once a second. Writes a file, so it is not real-time safe. One
/// thread.
class Ruby128PacketSender {
 public:
  Ruby128PacketSender(const ruby128::Ruby128Calibration& calibration, const Ruby128Unit& unit,
                      Ruby128PacketFacts facts);

  /// Writes the next packet from its columns. `first_column` is the index of the packet's first
  /// column in its group of firings.
  [[nodiscard]] Status send(std::span<const Ruby128Column> columns, int first_column,
                            capture::PcapWriter& capture);

 private:
  [[nodiscard]] Status send_difop(std::int64_t stamp_ns, std::int64_t captured_ns,
                                  capture::PcapWriter& capture);

  Ruby128PacketFacts facts_;
  ruby128::ruby128_wire::Difop difop_;
  ruby128::ruby128_wire::Packet packet_ = ruby128::blank_packet();
  std::optional<std::int64_t> next_difop_ns_;
};

}  // namespace terracut::packets
