// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "firmware_io/decode/column_returns.hpp"
#include "firmware_io/decode/frame_builder.hpp"
#include "firmware_io/decode/packet_azimuths.hpp"
#include "firmware_io/frame/range_image.hpp"

namespace terracut::decode {

/// Where the returns of a packet go.
struct PacketPlace {
  std::int64_t rotor_cdeg = 0;  ///< Placement::rotor_cdeg
  int late_columns = 0;         ///< The first so many are left out and counted.
  bool is_in_one_frame = false;
  frame::CellOwner owner{};
};

/// The returns of one packet, from its bytes to their cells.
///
/// `Sensor` is a trait: all that differs from model to model, resolved at compile time. It has
/// - `Calibration`, `Config`; `kRows` lasers; `kPacketBytes`, the size of a data packet;
///   `kClockWrap_us`, where the device clock wraps;
///   `kDefaultColumns`, `kDefaultReturnsPerCell`: Decoder::Config for single return at 10 Hz;
/// - a constructor (const Calibration&, const mount::Mount&, const Config&, int columns,
///   memory::FixedMemory&);
/// - `check(payload, PacketAzimuths&)`: the reason to reject a payload, or nothing and its heads;
/// - `spread(step_ticks)`: the BeamSpread around the head;
/// - `beam_ticks(laser)`: azimuth of a laser's beam minus the head's when it fires;
/// - `begin_packet(azimuths)`, then `read_column(payload, azimuths, column, found)` for each column
///   in turn, which fills in its ColumnReturns<kRows>;
/// - `rows()`: the range image row of each laser.
/// All but the constructor are noexcept. See hdl64e/hdl64e_sensor.hpp, ruby128/ruby128_sensor.hpp.
template <class Sensor>
class PacketReturns {
 public:
  template <class... Arguments>
  explicit PacketReturns(Arguments&&... of_sensor)
      : sensor_(std::forward<Arguments>(of_sensor)...) {}

  [[nodiscard]] Sensor& trait() noexcept { return sensor_; }
  [[nodiscard]] const Sensor& trait() const noexcept { return sensor_; }

  /// Reads a packet that the trait's check() has passed and places its returns.
  void place(std::span<const std::uint8_t> payload, const PacketAzimuths& azimuths,
             const PacketPlace& place, FrameBuilder& frames) noexcept {
    sensor_.begin_packet(azimuths);
    for (int column = 0; column < azimuths.columns; ++column) {
      sensor_.read_column(payload, azimuths, column, found_[static_cast<std::size_t>(column)]);
    }
    if (place.late_columns > 0) leave_out(place.late_columns, azimuths, frames.losses());
    const bool goes_by_laser = place.is_in_one_frame && place.late_columns == 0;
    if (goes_by_laser && place_by_laser(azimuths, place, frames)) return;
    place_by_firing(azimuths, place, frames);
  }

 private:
  static constexpr auto kLasers = static_cast<std::size_t>(Sensor::kRows);

  void leave_out(int late_columns, const PacketAzimuths& azimuths,
                 frame::LossCounters& losses) noexcept {
    for (std::size_t c = 0; c < static_cast<std::size_t>(late_columns); ++c) {
      for (std::uint16_t& raw : found_[c].raw) {
        losses.late_returns += raw != 0 ? 1U : 0U;
        raw = 0;
      }
    }
    // Both returns of a pair are one firing.
    losses.azimuth_hole_columns +=
        azimuths.dual_return ? 1U : static_cast<std::uint64_t>(late_columns);
  }

  /// Laser by laser. Each cache line of the image then is written once and not once a firing, which
  /// takes half the time. Returns false and places nothing where the overflow list might run full.
  [[nodiscard]] bool place_by_laser(const PacketAzimuths& azimuths, const PacketPlace& place,
                                    FrameBuilder& frames) noexcept {
    const auto columns = static_cast<std::size_t>(azimuths.columns);
    std::array<std::uint32_t, PacketAzimuths::kMaxColumns>
        number{};  // of each column's next return
    std::uint32_t returns = 0;
    for (std::size_t c = 0; c < columns; ++c) {
      number[c] = returns;
      for (const std::uint16_t raw : found_[c].raw) returns += raw != 0 ? 1U : 0U;
    }
    frame::RangeImage& image = frames.image(frame_of_beam(azimuths, place.rotor_cdeg, 0, 0));
    const std::optional<std::uint32_t> first = image.take_numbers(returns);
    if (!first) return false;
    for (std::uint32_t& next : number) next += *first;

    const std::span<const std::int32_t, kLasers> rows = sensor_.rows();
    for (std::size_t i = 0; i < kLasers; ++i) {
      // Which columns a laser found something in is as good as random, so no branch is asked to
      // guess it.
      std::array<std::uint8_t, PacketAzimuths::kMaxColumns> hits;
      std::size_t hit_count = 0;
      for (std::size_t c = 0; c < columns; ++c) {
        hits[hit_count] = static_cast<std::uint8_t>(c);
        hit_count += found_[c].raw[i] != 0 ? 1 : 0;
      }
      for (std::size_t n = 0; n < hit_count; ++n) {
        const std::size_t c = hits[n];
        image.place_numbered(rows[i], found_[c].column[i], point(c, i), place.owner, number[c]++);
      }
    }
    return true;
  }

  /// In the order of arrival, into any of the open frames.
  void place_by_firing(const PacketAzimuths& azimuths, const PacketPlace& place,
                       FrameBuilder& frames) noexcept {
    const std::span<const std::int32_t, kLasers> rows = sensor_.rows();
    for (std::size_t c = 0; c < static_cast<std::size_t>(azimuths.columns); ++c) {
      for (std::size_t i = 0; i < kLasers; ++i) {
        if (found_[c].raw[i] == 0) continue;
        frames.place(frame_of_beam(azimuths, place.rotor_cdeg, c, i), rows[i], found_[c].column[i],
                     point(c, i), place.owner);
      }
    }
  }

  [[nodiscard]] std::int64_t frame_of_beam(const PacketAzimuths& azimuths, std::int64_t rotor_cdeg,
                                           std::size_t column, std::size_t laser) const noexcept {
    const std::int64_t column_cdeg = rotor_cdeg + azimuths.advance_cdeg(static_cast<int>(column));
    return (column_cdeg - beams::wrap_cdeg(column_cdeg)) / beams::kRevolution_cdeg +
           found_[column].frame_offset[laser];
  }
  [[nodiscard]] frame::Return point(std::size_t column, std::size_t laser) const noexcept {
    const ColumnReturns<kLasers>& found = found_[column];
    return {found.x_m[laser], found.y_m[laser], found.z_m[laser], found.ground_range_m[laser],
            found.intensity[laser]};
  }

  Sensor sensor_;
  std::array<ColumnReturns<kLasers>, PacketAzimuths::kMaxColumns> found_{};
};

}  // namespace terracut::decode
