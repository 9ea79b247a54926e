// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "calib/beams/beam_table.hpp"
#include "reference_return.hpp"
#include "rotating_head.hpp"

namespace terracut::reference {

/// What the maker's manuals say of a model's packets and times, positions from the packet's first
/// byte.
struct HesaiSheet {
  sensor::SensorModel model{};
  int bytes = 0;  ///< Of a packet ...
  int more = 0;   ///< ... and of what may follow it.
  int first_block = 0, lasers = 0, blocks = 0;
  bool blocks_have_a_start = false;
  int bytes_a_return = 4;
  int mode_at = 0, microseconds_at = 0, date_at = 0;
  double block_us = 0;           ///< From a firing of all lasers to the next.
  std::vector<double> fired_us;  ///< As printed, from whatever moment.
  int least_distance = 1;        ///< Smaller ones are none.
  int version = 0;               ///< Byte 4 of the packets of some.
  int state_at = 0, state = 0;   ///< Of the operational state, and which; 0: has none.

  /// Of the number of lasers, before that of blocks.
  [[nodiscard]] int counts_at() const { return first_block == 8 ? 2 : 6; }
  [[nodiscard]] int block_bytes() const {
    return (blocks_have_a_start ? 4 : 2) + lasers * bytes_a_return;
  }
  [[nodiscard]] int azimuth_at(int block) const {
    return first_block + block * block_bytes() + (blocks_have_a_start ? 2 : 0);
  }
};
/// Of an OT128 or a Pandar128, also at high resolution.
[[nodiscard]] const HesaiSheet& hesai_sheet_of(sensor::SensorModel model, bool is_high = false);

/// A plain, slow decoder of Hesai's data packets, single and dual return, written from the manuals,
/// byte by byte and in double. It shares nothing with the product's decoder but the table's struct.
/// What no manual says is as terracut fixes it (VelodyneReference).
class HesaiReference {
 public:
  explicit HesaiReference(const beams::BeamTable& table)
      : table_(table), sheet_(hesai_sheet_of(table.model)) {}

  [[nodiscard]] Packet decode(std::span<const std::uint8_t> payload);

 private:
  beams::BeamTable table_;
  HesaiSheet sheet_;
  double last_step_deg_ = 0, last_us_ = -1;
  int last_cdeg_ = 0;
};

/// Data packets, byte by byte as the manuals describe them.
[[nodiscard]] std::vector<Payload> hesai_payloads(const HesaiSheet& sheet,
                                                  const RotatingHead& head);
void set_hesai_azimuth(const HesaiSheet& sheet, std::vector<std::uint8_t>& payload, int block,
                       unsigned cdeg);
void set_hesai_return(const HesaiSheet& sheet, std::vector<std::uint8_t>& payload, int block,
                      int laser, unsigned raw, unsigned intensity);
/// The device's clock, on the first of January 2026.
void set_hesai_clock(const HesaiSheet& sheet, std::vector<std::uint8_t>& payload,
                     std::int64_t time_ns);

}  // namespace terracut::reference
