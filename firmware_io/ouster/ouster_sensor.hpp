// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "calib/mount/mount.hpp"
#include "calib/ouster/ouster_calibration.hpp"
#include "firmware_io/frame/firing_tile.hpp"
#include "firmware_io/ouster/packet_reader.hpp"
#include "firmware_io/packet/beam_azimuth.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/firing_returns.hpp"
#include "firmware_io/packet/straight_point_kernel.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::ouster {

struct OusterConfig {};

/// Returns how the unit measures, for reading its packets.
[[nodiscard]] Mode mode_of(const OusterCalibration& calibration) noexcept;
/// Returns the beams' azimuth offsets in ticks (packet_azimuths.hpp), by laser.
[[nodiscard]] std::vector<std::int32_t> beam_ticks(const OusterCalibration& calibration);
/// Returns the transform from the rotating lidar's frame to the vehicle's.
[[nodiscard]] mount::RigidTransform T_vehicle_lidar(const OusterCalibration& calibration,
                                                    const mount::Mount& mount) noexcept;

/// The trait of an Ouster of so many rows for the Decoder. All lasers fire at once for a column.
template <int kRowsOfUnit>
class OusterSensor {
 public:
  using Calibration = OusterCalibration;
  using Config = OusterConfig;
  static constexpr int kRows = kRowsOfUnit, kChannels = kRowsOfUnit;
  static constexpr std::size_t kGroups = 1;
  /// Of the longest profile.
  static constexpr std::size_t kPacketBytes =
      PacketFormat{.profile = Profile::kDual, .rows = kRows}.packet_bytes();
  static constexpr std::int64_t kClockWrap_us = ouster::kClockWrap_us;
  static constexpr int kDefaultColumns = 1024;
  /// Both returns of a firing are in one cell, and no other firing's.
  static constexpr int kDefaultReturnsPerCell = 2;
  static constexpr bool kHasFineDistances = true;

  OusterSensor(const Calibration& unit, const mount::Mount& mount, const Config& /*config*/)
      : mode_(mode_of(unit)),
        kernel_(unit.lasers, T_vehicle_lidar(unit, mount), unit.ahead_m),
        beam_origin_m_(static_cast<float>(unit.beam_origin_m)) {
    const std::vector<int> rows = mount::rows_upward(rows_by_elevation(unit), mount);
    std::ranges::copy(rows, rows_.begin());
    std::ranges::copy(ouster::beam_ticks(unit), ticks_.begin());
  }

  [[nodiscard]] std::optional<frame::Reject> check(const packet::Datagram& datagram,
                                                   packet::PacketAzimuths& azimuths) const noexcept
      TERRACUT_NONBLOCKING {
    return read_packet(mode_, datagram.payload, azimuths);
  }
  [[nodiscard]] packet::BeamSpread spread(std::int32_t /*step_ticks*/) const noexcept {
    const auto [least, most] = std::ranges::minmax(ticks_);
    return {least, most + packet::kTicksPerCdeg};
  }
  [[nodiscard]] std::int32_t beam_ticks(int channel) const noexcept {
    return ticks_[static_cast<std::size_t>(channel)];
  }
  [[nodiscard]] static std::size_t group(std::size_t /*channel*/) noexcept { return 0; }
  /// Azimuths in hundredths of a degree are too coarse; the rest is added as an advance.
  [[nodiscard]] static std::int32_t advance_ticks(std::int32_t rest_ticks, std::size_t /*group*/,
                                                  bool /*dual_return*/) noexcept {
    return rest_ticks;
  }
  static void begin_packet(const packet::PacketAzimuths& /*azimuths*/) noexcept {}
  [[nodiscard]] std::int32_t step_ticks(const packet::PacketAzimuths& azimuths,
                                        std::size_t column) const noexcept {
    return rest_ticks(azimuths.azimuth_cdeg[column], mode_.columns_per_frame);
  }
  void read_column(std::span<const std::uint8_t> payload, std::size_t column,
                   const packet::FiringReturns<kChannels>& found) const noexcept
      TERRACUT_NONBLOCKING {
    read_returns(mode_.format, payload.data(), column, found.raw, found.fine, found.intensity);
  }
  [[nodiscard]] static float metres_per_count() noexcept {
    return frame::kFinePerCount * 1e-3F;  // ranges are millimetres
  }
  void compute_points(std::size_t channel, const packet::LaserHeads& heads,
                      const frame::TileRow<float>& range_m,
                      const frame::PointsOut& out) const noexcept TERRACUT_NONBLOCKING {
    frame::TileRow<float> measured_m;
    for (std::size_t f = 0; f < measured_m.size(); ++f) measured_m[f] = range_m[f] - beam_origin_m_;
    kernel_.compute(channel, heads, measured_m, out);
  }
  [[nodiscard]] std::span<const std::int32_t, static_cast<std::size_t>(kChannels)> rows()
      const noexcept {
    return rows_;
  }

 private:
  Mode mode_;
  packet::StraightPointKernel kernel_;
  float beam_origin_m_;
  std::array<std::int32_t, kChannels> ticks_{};  ///< Azimuth offsets of the beams.
  std::array<std::int32_t, kChannels> rows_{};
};

/// A list of numbers of rows, for code that folds over units.
template <int kFirst, int... kRest>
struct RowsList {
  /// `Template` with the numbers of rows as arguments.
  template <template <int...> class Template>
  using In = Template<kFirst, kRest...>;

  /// Calls `use` with the std::integral_constant of the given number and returns the result. For
  /// one not in the list, calls it with the list's last.
  template <class Use>
  static decltype(auto) with(int rows, const Use& use) {
    if constexpr (sizeof...(kRest) == 0) {
      return use(std::integral_constant<int, kFirst>{});
    } else {
      if (rows == kFirst) return use(std::integral_constant<int, kFirst>{});
      return RowsList<kRest...>::with(rows, use);
    }
  }
};
using Models = RowsList<kRows[0], kRows[1], kRows[2]>;

}  // namespace terracut::ouster
