// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "calib/beams/beam_table.hpp"
#include "reference_return.hpp"
#include "rotating_head.hpp"

namespace terracut::reference {

/// What the maker's manuals and driver say of a RoboSense with 32 lasers.
struct RoboSenseSheet {
  sensor::SensorModel model{};
  std::vector<int> start;  ///< The packet's first bytes.
  int type = 0;            ///< Byte 31.
  double block_us = 0;     ///< From a firing of all lasers to the next.
  std::vector<double> fired_us;
  double metres = 0, lens_ahead_m = 0;
  bool has_calendar = false;  ///< Stamps are a date, not seconds since 1970.
  double device_angle_deg = 0;
};
[[nodiscard]] const RoboSenseSheet& robosense_sheet_of(sensor::SensorModel model);

/// A plain, slow decoder of their data packets, written from the manuals, byte by byte and in
/// double. It shares nothing with the product's decoder but the table's struct. What no manual says
/// is as terracut fixes it (VelodyneReference).
class RoboSenseReference {
 public:
  explicit RoboSenseReference(const beams::BeamTable& table)
      : table_(table), sheet_(robosense_sheet_of(table.model)) {}

  [[nodiscard]] Packet decode(std::span<const std::uint8_t> payload) const;

 private:
  beams::BeamTable table_;
  RoboSenseSheet sheet_;
};

/// Data packets, byte by byte as the manuals describe them.
[[nodiscard]] std::vector<Payload> robosense_payloads(const RoboSenseSheet& sheet,
                                                      const RotatingHead& head);
void set_robosense_azimuth(std::vector<std::uint8_t>& payload, int block, unsigned cdeg);
void set_robosense_return(std::vector<std::uint8_t>& payload, int block, int laser, unsigned raw,
                          unsigned intensity);
void set_robosense_clock(const RoboSenseSheet& sheet, std::vector<std::uint8_t>& payload,
                         std::int64_t time_ns);

/// A device packet with a unit's angles.
[[nodiscard]] std::vector<std::uint8_t> robosense_device_payload(const beams::BeamTable& table);

}  // namespace terracut::reference
