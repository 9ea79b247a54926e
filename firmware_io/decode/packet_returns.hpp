// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "calib/beams/angle.hpp"
#include "firmware_io/decode/frame_builder.hpp"
#include "firmware_io/decode/sensor_tile_reader.hpp"
#include "firmware_io/decode/tile_columns.hpp"
#include "firmware_io/frame/range_image.hpp"
#include "firmware_io/packet/firing_returns.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/packet/rotor_directions.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::decode {

/// Where the returns of a packet belong.
struct PacketPlace {
  std::int64_t rotor_cdeg = 0;  ///< See Placement::rotor_cdeg.
  int late_columns = 0;  ///< Number of columns at the beginning that are left out and counted.
  frame::CellOwner owner{};
};

/// Takes the returns of packets from their bytes to their cells. Collects several packets, then
/// places their returns laser by laser:
///
///   packet  --transposed-->  tile: what each laser found in 24 firings, next to the core
///   tile    --a laser's constants, 24 firings in vectors-->  points, next to each other in a row
///
/// `Sensor` is a trait: it has all that differs from model to model, resolved at compile time:
/// - the types `Calibration` and `Config`;
/// - `kRows`, the rows of the image;
/// - `kChannels`, the readings in a column, called lasers below: one for each laser, or more if a
///   laser fires more than once for one azimuth; a multiple of 8;
/// - `kGroups`, the number of groups of lasers that fire together;
/// - `kPacketBytes`, the size of a data packet;
/// - `kClockWrap_us`, where the device clock wraps;
/// - `kDefaultColumns`, `kDefaultReturnsPerCell`: Decoder::Config for single return at 10 Hz;
/// - a constructor (const Calibration&, const mount::Mount&, const Config&);
/// - `check(Datagram, PacketAzimuths&)`: returns the reason to reject a packet, or reads its heads;
/// - `spread(step_ticks)`: the packet::BeamSpread around the head;
/// - `beam_ticks(laser)`: azimuth of a laser's beam minus the head's when it fires;
/// - `group(laser)`: the group of a laser;
/// - `advance_ticks(step_ticks, group, dual_return)`: how far the head has rotated from a firing's
///   azimuth when the group fires, [0, 1e5];
/// - `begin_packet(azimuths)`, to be called for each packet in order of arrival;
/// - `step_ticks(azimuths, column)`: the head's step at a column;
/// - `read_column(payload, column, FiringReturns<kChannels>)`: fills in a column's returns;
/// - `metres_per_count()`, and `compute_points(laser, LaserHeads, measured_m, frame::PointsOut)`;
/// - `rows()`: the range image row of each laser.
/// All but the constructor are noexcept. See hdl64e/hdl64e_sensor.hpp, ruby128/ruby128_sensor.hpp,
/// velodyne/velodyne_sensor.hpp.
template <class Sensor>
class PacketReturns {
 public:
  /// `columns` is the number of columns of the range image, [16, 36000].
  PacketReturns(const typename Sensor::Calibration& calibration, const mount::Mount& mount,
                const typename Sensor::Config& config, int columns, memory::FixedMemory& memory)
      : sensor_(calibration, mount, config),
        columns_(columns),
        directions_(memory),
        columns_of_(sensor_, columns, memory),
        reader_(sensor_, memory),
        tile_(memory.take<packet::FiringTile<kLasers>>("decoder tables", 1)),
        beams_(memory.take<frame::BeamColumns>("decoder tables", kLasers)),
        points_(memory.take<frame::TilePoints>("decoder tables", kLasers)) {}

  /// Makes a reader that turns frames kept as measured into points, on any one thread.
  [[nodiscard]] std::unique_ptr<frame::TileReader> make_reader(memory::FixedMemory& memory) const {
    return std::make_unique<SensorTileReader<Sensor>>(sensor_, memory);
  }

  [[nodiscard]] Sensor& trait() noexcept { return sensor_; }
  [[nodiscard]] const Sensor& trait() const noexcept { return sensor_; }

  /// Reads a packet that the trait's check() has accepted. flush() places its returns, or a later
  /// add() once enough are collected; the packet's frames must stay open until then.
  void add(std::span<const std::uint8_t> payload, const packet::PacketAzimuths& azimuths,
           const PacketPlace& place, FrameBuilder& frames) noexcept {
    const auto columns = static_cast<std::size_t>(azimuths.columns);
    if (place.owner != owner_ || firings_ + columns > frame::kTileFirings) flush(frames);
    owner_ = place.owner;
    sensor_.begin_packet(azimuths);
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t firing = firings_ + c;
      sensor_.read_column(payload, c, tile_[0].firing(firing));
      rotor_cdeg_[firing] = place.rotor_cdeg + azimuths.advance_cdeg(static_cast<int>(c));
      heads_.step_ticks[firing] = sensor_.step_ticks(azimuths, c);
      const std::uint32_t bit = 1U << firing;
      heads_.is_dual = azimuths.dual_return ? heads_.is_dual | bit : heads_.is_dual & ~bit;
    }
    if (place.late_columns > 0) leave_out(place.late_columns, azimuths, frames.losses());
    firings_ += columns;
    if (firings_ == frame::kTileFirings) flush(frames);
  }
  /// Places all returns added.
  void flush(FrameBuilder& frames) noexcept {
    if (firings_ == 0) return;
    const std::size_t firings = std::exchange(firings_, 0);
    complete(firings);
    tile_[0].turn();
    if (frames.keeps_measured()) return keep(find_cells(firings, frames, false), frames);
    const Tile tile = find_cells(firings, frames, true);
    if (!place_by_laser(tile)) place_by_firing(tile, frames);
  }
  /// True if all returns added are placed.
  [[nodiscard]] bool is_flushed() const noexcept { return firings_ == 0; }

 private:
  static constexpr auto kLasers = static_cast<std::size_t>(Sensor::kChannels);

  /// The returns that are to be placed together, and their frames.
  struct Tile {
    std::size_t firings;
    std::int64_t first_frame;                  ///< Number of the older of the two frames.
    std::array<frame::RangeImage*, 2> images;  ///< Images of the two frames.
    bool is_in_one_frame;
    std::size_t frame;  ///< Index of the frame, if all returns are in one.
  };
  using Numbers = std::array<frame::TileRow<std::uint32_t>, 2>;  ///< Indexed by frame and firing.

  void leave_out(int late_columns, const packet::PacketAzimuths& azimuths,
                 frame::LossCounters& losses) noexcept {
    for (std::size_t c = 0; c < static_cast<std::size_t>(late_columns); ++c) {
      for (std::uint16_t& raw : tile_[0].arrived_raw[firings_ + c]) {
        losses.late_returns += std::exchange(raw, std::uint16_t{0}) != 0 ? 1U : 0U;
      }
    }
    // Both returns of a pair count as one firing.
    losses.azimuth_hole_columns +=
        azimuths.dual_return ? 1U : static_cast<std::uint64_t>(late_columns);
  }

  /// Fills the rest of an incomplete tile with firings that have no returns.
  void complete(std::size_t firings) noexcept {
    if (firings == frame::kTileFirings) return;
    for (std::size_t f = firings; f < frame::kTileFirings; ++f) {
      tile_[0].arrived_raw[f].fill(0);
      rotor_cdeg_[f] = rotor_cdeg_[firings - 1];
      heads_.step_ticks[f] = heads_.step_ticks[firings - 1];
    }
  }

  [[nodiscard]] Tile find_cells(std::size_t firings, FrameBuilder& frames,
                                bool makes_points) noexcept {
    const std::int64_t first_frame = frames.oldest();
    for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
      heads_.head_cdeg[f] =
          static_cast<std::int32_t>(rotor_cdeg_[f] - first_frame * beams::kRevolution_cdeg);
      const packet::SinCos direction = directions_.at(beams::wrap_cdeg(heads_.head_cdeg[f]));
      heads_.sin_head[f] = direction.sin;
      heads_.cos_head[f] = direction.cos;
    }
    if (makes_points) reader_.open(heads_, tile_[0].raw[0].data());
    columns_of_.find(sensor_, heads_, beams_);
    std::int32_t least = 0, most = 0;
    for (std::size_t i = 0; i < kLasers; ++i) {
      least = i == 0 ? beams_[i].least : std::min(least, beams_[i].least);
      most = i == 0 ? beams_[i].most : std::max(most, beams_[i].most);
    }
    return {.firings = firings,
            .first_frame = first_frame,
            .images = {&frames.image(first_frame), &frames.image(first_frame + 1)},
            .is_in_one_frame = most < columns_ || least >= columns_,
            .frame = most < columns_ ? 0U : 1U};
  }

  /// Keeps the tile as measured in each frame that has returns of it.
  void keep(const Tile& tile, FrameBuilder& frames) noexcept {
    for (std::size_t n = 0; n < 2; ++n) {
      if (tile.is_in_one_frame && tile.frame != n) continue;
      frame::TileHeads heads = heads_;
      if (n == 1) {
        for (std::int32_t& head_cdeg : heads.head_cdeg) head_cdeg -= beams::kRevolution_cdeg;
      }
      frames.losses().overflow_full_returns +=
          tile.images[n]->measured()->add({.heads = heads,
                                           .raw = tile_[0].raw[0].data(),
                                           .intensity = tile_[0].intensity[0].data(),
                                           .beams = beams_,
                                           .first_column = n == 0 ? 0 : columns_},
                                          owner_, reader_);
    }
  }

  /// Counts the returns of each firing by frame.
  [[nodiscard]] Numbers count(const Tile& tile) const noexcept {
    Numbers counts{};
    if (tile.is_in_one_frame) {
      frame::TileRow<std::uint16_t> all{};
      for (const frame::TileRow<std::uint16_t>& raw : tile_[0].raw) {
        for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
          all[f] = static_cast<std::uint16_t>(all[f] + std::uint16_t{raw[f] != 0});
        }
      }
      std::ranges::copy(all, counts[tile.frame].begin());
      return counts;
    }
    for (std::size_t i = 0; i < kLasers; ++i) {
      for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
        counts[frame_of(beams_[i].column[f])][f] += tile_[0].raw[i][f] != 0 ? 1U : 0U;
      }
    }
    return counts;
  }
  [[nodiscard]] std::size_t frame_of(std::int32_t column) const noexcept {
    return column >= columns_ ? 1U : 0U;
  }

  [[nodiscard]] int column_in(std::size_t frame, std::int32_t column) const noexcept {
    return frame == 0 ? column : column - columns_;
  }

  /// Places the tile's returns laser by laser. Returns false and places nothing if an overflow list
  /// might become full.
  [[nodiscard]] bool place_by_laser(const Tile& tile) noexcept {
    Numbers numbers = count(tile);
    std::array<std::uint32_t, 2> returns{};
    for (std::size_t n = 0; n < 2; ++n) {
      for (std::uint32_t& number : numbers[n]) {
        number = std::exchange(returns[n], returns[n] + number);
      }
      if (!tile.images[n]->has_room_for(returns[n])) return false;
    }
    for (std::size_t n = 0; n < 2; ++n) {
      const std::uint32_t first = tile.images[n]->take_numbers(returns[n]);
      for (std::uint32_t& number : numbers[n]) number += first;
    }
    for (std::size_t i = 0; i < kLasers; ++i) {
      const bool is_run = beams_[i].is_one_run && tile.is_in_one_frame;
      if (is_run && tile.firings == frame::kTileFirings &&
          place_run(tile, i, numbers[tile.frame])) {
        continue;
      }
      place_one_by_one(tile, i, numbers);
    }
    return true;
  }

  /// Places a laser's returns in adjacent columns; false if one of the cells is taken.
  [[nodiscard]] bool place_run(const Tile& tile, std::size_t laser,
                               frame::TileRow<std::uint32_t>& numbers) noexcept {
    frame::RangeImage& image = *tile.images[tile.frame];
    const int row = sensor_.rows()[laser];
    const int column = column_in(tile.frame, beams_[laser].least);
    if (!image.is_empty_from(row, column)) return false;
    image.fetch_to_write(row, column + int{frame::kTileFirings});
    const frame::RangeImage::Cells cells = image.take_cells(row, column, frame::kTileFirings);
    reader_.compute_points(laser, {cells.x_m, cells.y_m, cells.z_m, cells.ground_range_m});
    packet::fill_cells(tile_[0].raw[laser], tile_[0].intensity[laser], cells, numbers);
    return true;
  }

  /// Places returns one by one. Needed for firings that share or skip a column, come late or cross
  /// the seam.
  void place_one_by_one(const Tile& tile, std::size_t laser, Numbers& numbers) noexcept {
    reader_.compute_points(laser, all_of(points_[laser]));
    const frame::TileRow<std::int32_t>& column = beams_[laser].column;
    const int row = sensor_.rows()[laser];
    const std::size_t newest = frame_of(beams_[laser].most);
    tile.images[newest]->fetch_to_write(row, column_in(newest, beams_[laser].most));
    // A branch would be mispredicted: which firings have a return is nearly random.
    std::array<std::uint8_t, frame::kTileFirings> hits;
    std::size_t hit_count = 0;
    for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
      hits[hit_count] = static_cast<std::uint8_t>(f);
      hit_count += tile_[0].raw[laser][f] != 0 ? 1 : 0;
    }
    for (std::size_t n = 0; n < hit_count; ++n) {
      const std::size_t f = hits[n];
      const std::size_t frame = frame_of(column[f]);
      tile.images[frame]->place_numbered(row, column_in(frame, column[f]), point(laser, f), owner_,
                                         numbers[frame][f]++);
    }
  }

  /// Places the returns in order of arrival.
  void place_by_firing(const Tile& tile, FrameBuilder& frames) noexcept {
    for (std::size_t i = 0; i < kLasers; ++i) reader_.compute_points(i, all_of(points_[i]));
    const std::span<const std::int32_t, kLasers> rows = sensor_.rows();
    for (std::size_t f = 0; f < tile.firings; ++f) {
      for (std::size_t i = 0; i < kLasers; ++i) {
        if (tile_[0].raw[i][f] == 0) continue;
        const std::int32_t column = beams_[i].column[f];
        const std::size_t frame = frame_of(column);
        frames.place(tile.first_frame + static_cast<std::int64_t>(frame), rows[i],
                     column_in(frame, column), point(i, f), owner_);
      }
    }
  }

  [[nodiscard]] frame::Return point(std::size_t laser, std::size_t firing) const noexcept {
    const frame::TilePoints& points = points_[laser];
    return {points.x_m[firing], points.y_m[firing], points.z_m[firing],
            points.ground_range_m[firing], tile_[0].intensity[laser][firing]};
  }

  Sensor sensor_;
  int columns_;
  packet::RotorDirections directions_;
  TileColumns<Sensor> columns_of_;
  SensorTileReader<Sensor> reader_;
  std::span<packet::FiringTile<kLasers>> tile_;  ///< A span of one tile.
  std::span<frame::BeamColumns> beams_;          ///< Indexed by laser.
  /// Indexed by laser; used if the cells do not hold the points.
  std::span<frame::TilePoints> points_;
  frame::TileRow<std::int64_t> rotor_cdeg_{};  ///< Indexed by firing.
  frame::TileHeads heads_{};
  std::size_t firings_ = 0;  ///< Firings added and not placed yet.
  frame::CellOwner owner_{};
};

}  // namespace terracut::decode
