// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "calib/beams/beam_table.hpp"

namespace terracut::reference {

/// One return as a reference decoder reads it. Lengths in metres in the sensor frame: x forward,
/// y left, z up. Azimuths clockwise seen from above.
struct Return {
  int column = 0;        ///< In the packet: one reading of all lasers each, in the packet's order.
  int laser = 0;         ///< By its number on the wire.
  int raw_distance = 0;  ///< Counts, 1..65535.
  int intensity = 0;     ///< As on the wire.
  double rotor_deg = 0;  ///< Where the head points when the laser fires: [0, 360) or a bit beyond.
  double beam_deg = 0;   ///< Where the beam points, in the same frame as rotor_deg.
  double x_m = 0, y_m = 0, z_m = 0;
  double fired_us = 0;  ///< After the first firing of the packet.
};

/// Why a payload is no data packet that could be decoded.
enum class Refusal : std::uint8_t {
  kNone,
  kOtherPacket,     ///< No data packet of this sensor, by its size or the bytes that tell.
  kAzimuthRange,    ///< An azimuth of 360 degrees or more.
  kUnequalFirings,  ///< Blocks that fire together carry different azimuths.
  kUneven,          ///< The azimuths are not those of a head rotating clockwise.
  kNotRotating,     ///< The azimuths hardly differ.
};

[[nodiscard]] std::string_view to_string(Refusal refusal);

/// What no format says but terracut fixes: hundredths of a degree that a head may rotate from one
/// column to the next, either way; the least it must rotate in a packet, else it stands still; and
/// how far back it may come in a packet and still be thought to stand.
struct RotorLimits {
  int forwards_cdeg = 0, backwards_cdeg = 0;
  int least_sweep_cdeg = 0, standing_back_cdeg = 0;
};

/// Whether these azimuths, each in [0, 36000), can be a rotating head's.
[[nodiscard]] Refusal judge_rotation(std::span<const int> azimuths_cdeg, const RotorLimits& limits);

/// Hundredths of a degree clockwise from one azimuth to another, the short way: [-18000, 18000).
[[nodiscard]] int clockwise_cdeg(int from_cdeg, int to_cdeg);

/// One payload, decoded or refused.
struct Packet {
  Refusal refusal = Refusal::kNone;
  bool dual_return = false;
  int columns = 0;
  double first_deg = 0;         ///< Azimuth of the first column, [0, 360).
  double step_deg = 0;          ///< From firing to firing.
  std::vector<Return> returns;  ///< In order of arrival: block, laser.
};

/// Which frame each return belongs to, in a stream whose packets follow each other by less than
/// half a frame. Frame 0 is the one in which the first packet's first column was measured.
class Frames {
 public:
  /// To be called once a packet, in order: degrees to add to the packet's azimuths.
  [[nodiscard]] double unwrap(const Packet& packet);

 private:
  bool started_ = false;
  double last_deg_ = 0;
};

/// The product counts azimuths in whole ticks of 1e-5 degrees and cuts off twice on the way there:
/// a beam nearer than this to a border between columns may be on either side of it.
inline constexpr double kBorder_deg = 2e-5;

/// Frame and column of a beam that points to `unwrapped_deg`, and how far it is from the nearest
/// border between two columns.
struct Cell {
  std::int64_t frame = 0;
  int column = 0;
  double border_deg = 0;
};
[[nodiscard]] Cell cell_of(double unwrapped_deg, int columns);

/// How far a beam is from the nearest border between two frames.
[[nodiscard]] double seam_distance_deg(double beam_deg);

/// The elevation of each beam.
[[nodiscard]] std::vector<double> elevations_of(std::span<const beams::TableBeam> beams);

/// The rank of each elevation, 0 for the lowest; of equal ones the earlier is the lower.
[[nodiscard]] std::vector<int> rank_of_elevation(const std::vector<double>& elevations);

}  // namespace terracut::reference
