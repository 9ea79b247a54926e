// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "calib/beams/angle.hpp"
#include "firmware_io/decode/frame_builder.hpp"
#include "firmware_io/decode/sensor_tile_reader.hpp"
#include "firmware_io/decode/sensor_trait.hpp"
#include "firmware_io/decode/tile_columns.hpp"
#include "firmware_io/frame/measured_returns.hpp"
#include "firmware_io/packet/firing_returns.hpp"
#include "firmware_io/packet/packet_azimuths.hpp"
#include "firmware_io/packet/rotor_directions.hpp"
#include "rt/memory/fixed_memory.hpp"

namespace terracut::decode {

/// Where the returns of a packet belong.
struct PacketPlace {
  std::int64_t rotor_cdeg = 0;  ///< See Placement::rotor_cdeg.
  std::int64_t stamp_ns = 0;    ///< Of the packet's datagram.
  int late_columns = 0;  ///< Number of columns at the beginning that are left out and counted.
  frame::CellOwner owner{};
};

/// Takes the returns of packets from their bytes to their frames. Collects several packets, or
/// parts of large ones, then adds their returns to one or two frames, and finds the cells that they
/// own:
///
///   packet  --transposed-->  tile: what each laser found in 24 firings, next to the core
///   tile    --a laser's constants, 24 firings in vectors-->  columns of the returns, their owners
///
template <SensorTrait Sensor>
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
        tile_(memory.take<Tile>("decoder tables", 1)),
        beams_(memory.take<frame::BeamColumns>("decoder tables", kLasers)) {}

  /// Makes a reader that turns frames into points, on any one thread.
  [[nodiscard]] std::unique_ptr<frame::TileReader> make_reader(memory::FixedMemory& memory) const {
    return std::make_unique<SensorTileReader<Sensor>>(sensor_, memory);
  }

  [[nodiscard]] Sensor& trait() noexcept { return sensor_; }
  [[nodiscard]] const Sensor& trait() const noexcept { return sensor_; }

  /// Reads a packet that the trait's check() has accepted. flush() places its returns, or a later
  /// add() once enough are collected; the packet's frames must stay open until then. Returns true
  /// if it has placed all returns of the packets before.
  bool add(std::span<const std::uint8_t> payload, const packet::PacketAzimuths& azimuths,
           const PacketPlace& place, FrameBuilder& frames) noexcept {
    const auto columns = static_cast<std::size_t>(azimuths.columns);
    const bool may_be_split = columns > frame::kTileFirings / 2;
    const bool fits = may_be_split || firings_ + columns <= frame::kTileFirings;
    bool has_placed = firings_ == 0;
    const auto place_all = [&] {
      flush(frames);
      has_placed = true;
    };
    if (place.owner != owner_ || !fits) place_all();
    owner_ = place.owner;
    sensor_.begin_packet(azimuths);
    for (std::size_t c = 0; c < columns; ++c) {
      const std::size_t firing = firings_;
      sensor_.read_column(payload, c, tile_[0].firing(firing));
      rotor_cdeg_[firing] = place.rotor_cdeg + azimuths.advance_cdeg(static_cast<int>(c));
      heads_.step_ticks[firing] = sensor_.step_ticks(azimuths, c);
      const std::uint32_t bit = 1U << firing;
      heads_.is_dual = azimuths.dual_return ? heads_.is_dual | bit : heads_.is_dual & ~bit;
      if (firings_ == 0) first_ns_ = place.stamp_ns;
      last_ns_ = place.stamp_ns;
      if (c < static_cast<std::size_t>(place.late_columns)) leave_out(firing, frames.losses());
      if (++firings_ == frame::kTileFirings) place_all();
    }
    // Both returns of a pair count as one firing.
    if (place.late_columns > 0) {
      frames.losses().azimuth_hole_columns +=
          azimuths.dual_return ? 1U : static_cast<std::uint64_t>(place.late_columns);
    }
    return has_placed;
  }
  /// Places all returns added.
  void flush(FrameBuilder& frames) noexcept {
    if (firings_ == 0) return;
    complete(std::exchange(firings_, 0));
    tile_[0].turn();
    const std::int64_t first_frame = frames.oldest();
    const frame::ColumnRange columns = find_columns(first_frame);
    if (columns.begin < columns_) add_tile(0, frames.returns_of(first_frame), frames.losses());
    if (columns.end > columns_) add_tile(1, frames.returns_of(first_frame + 1), frames.losses());
  }
  /// True if all returns added are placed.
  [[nodiscard]] bool is_flushed() const noexcept { return firings_ == 0; }

 private:
  static constexpr auto kLasers = static_cast<std::size_t>(Sensor::kChannels);
  using Tile = packet::FiringTile<kLasers, kHasFineDistancesOf<Sensor>>;

  void leave_out(std::size_t firing, frame::LossCounters& losses) noexcept {
    for (std::uint16_t& raw : tile_[0].arrived_raw[firing]) {
      losses.late_returns += std::exchange(raw, std::uint16_t{0}) != 0 ? 1U : 0U;
    }
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

  /// Finds the tile's columns, counted from the first one of `first_frame`, and returns the range
  /// they lie in.
  [[nodiscard]] frame::ColumnRange find_columns(std::int64_t first_frame) noexcept {
    for (std::size_t f = 0; f < frame::kTileFirings; ++f) {
      heads_.head_cdeg[f] =
          static_cast<std::int32_t>(rotor_cdeg_[f] - first_frame * beams::kRevolution_cdeg);
      const packet::SinCos direction = directions_.at(beams::wrap_cdeg(heads_.head_cdeg[f]));
      heads_.sin_head[f] = direction.sin;
      heads_.cos_head[f] = direction.cos;
    }
    columns_of_.find(sensor_, heads_, beams_);
    frame::ColumnRange columns{beams_[0].least, beams_[0].most + 1};
    for (const frame::BeamColumns& beam : beams_) {
      columns.begin = std::min(columns.begin, beam.least);
      columns.end = std::max(columns.end, beam.most + 1);
    }
    return columns;
  }

  /// Adds the tile's returns in the n-th frame from the one in which columns are counted.
  void add_tile(int n, frame::MeasuredReturns& returns, frame::LossCounters& losses) noexcept {
    frame::TileHeads heads = heads_;
    for (std::int32_t& head_cdeg : heads.head_cdeg) head_cdeg -= n * beams::kRevolution_cdeg;
    losses.overflow_full_returns += returns.add({.heads = heads,
                                                 .distances = tile_[0].distances(),
                                                 .intensity = tile_[0].intensity[0].data(),
                                                 .beams = beams_,
                                                 .first_column = n * columns_,
                                                 .first_ns = first_ns_,
                                                 .last_ns = last_ns_},
                                                owner_, reader_);
  }

  Sensor sensor_;
  int columns_;
  packet::RotorDirections directions_;
  TileColumns<Sensor> columns_of_;
  SensorTileReader<Sensor> reader_;
  std::span<Tile> tile_;                       ///< A span of one tile.
  std::span<frame::BeamColumns> beams_;        ///< Indexed by laser.
  frame::TileRow<std::int64_t> rotor_cdeg_{};  ///< Indexed by firing.
  frame::TileHeads heads_{};
  std::size_t firings_ = 0;                  ///< Firings added and not placed yet.
  std::int64_t first_ns_ = 0, last_ns_ = 0;  ///< Stamps of the packets of the tile.
  frame::CellOwner owner_{};
};

}  // namespace terracut::decode
