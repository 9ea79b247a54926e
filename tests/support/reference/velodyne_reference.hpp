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

/// What the maker's manuals say of a model's packets and times.
struct VelodyneSheet {
  sensor::SensorModel model{};
  int product = 0;
  int lasers = 0;
  double metres_per_count = 0;
  double firing_us = 0;     ///< From a firing of all lasers to the next.
  double step_us = 0;       ///< From lasers that fire together to the next ones ...
  int together = 1;         ///< ... which are so many.
  int firings_a_block = 1;  ///< Firings of all lasers that a block holds, or ...
  int blocks_a_firing = 1;  ///< ... blocks that one fills.
  int pause_after = 1'000;  ///< After so many steps two are left out.

  [[nodiscard]] double fired_us(int laser) const {
    const int step = laser / together;
    return (step + step / pause_after * 2) * step_us;
  }
};
[[nodiscard]] const VelodyneSheet& sheet_of(sensor::SensorModel model);

/// A plain, slow decoder of the data packets of Velodyne's smaller models, single and dual return,
/// written from the manuals, byte by byte and in double. It shares nothing with the product's
/// decoder but the table's struct.
///
/// What no manual says is as terracut fixes it: the step from firing to firing is the packet's
/// mean; where it holds one firing, the way from the packet before where that is the one before,
/// else the last step, else that at 10 turns a second.
class VelodyneReference {
 public:
  explicit VelodyneReference(const beams::BeamTable& table)
      : table_(table), sheet_(sheet_of(table.model)) {}

  /// `column` of a return is its firing in the packet; in dual return those of both blocks count.
  /// `across_sector`: of a packet that goes on behind a blind sector; its step is the last one.
  [[nodiscard]] Packet decode(std::span<const std::uint8_t> payload, bool across_sector = false);

 private:
  beams::BeamTable table_;
  VelodyneSheet sheet_;
  double last_step_deg_ = 0, last_us_ = -1;
  int last_cdeg_ = 0;
};

/// Data packets, byte by byte as the manuals describe them.
[[nodiscard]] std::vector<Payload> velodyne_payloads(const VelodyneSheet& sheet,
                                                     const RotatingHead& head);
/// The azimuth of the block that holds firing `column` of a packet, where that is its first one.
void set_velodyne_azimuth(const VelodyneSheet& sheet, std::vector<std::uint8_t>& payload,
                          int column, unsigned cdeg);
void set_velodyne_return(const VelodyneSheet& sheet, std::vector<std::uint8_t>& payload, int column,
                         int laser, unsigned raw, unsigned intensity);
void set_velodyne_clock(std::vector<std::uint8_t>& payload, std::int64_t time_ns);

/// Any unit about the model's table.
[[nodiscard]] beams::BeamTable random_table(sensor::SensorModel model, std::mt19937& random);

}  // namespace terracut::reference
