// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "calib/mount/mount.hpp"
#include "firmware_io/hesai/packet_reader.hpp"
#include "firmware_io/packet/datagram.hpp"
#include "firmware_io/packet/wire_returns.hpp"
#include "firmware_io/table/table_sensor.hpp"
#include "rt/threads/nonblocking.hpp"

namespace terracut::hesai {

struct HesaiConfig {
  /// Which azimuth a beam has: the head's when its laser fires, or, if false, its block's.
  bool follows_firing = true;
};

/// The trait of a Hesai sensor for the Decoder; `Model` as table::TableSensor says.
template <class Model>
class HesaiSensor : public table::TableSensor<Model> {
  using Table = table::TableSensor<Model>;

 public:
  using Config = HesaiConfig;
  static constexpr std::size_t kPacketBytes =
      Model::kLayout.packet_bytes() + Model::kLayout.extra_bytes;
  static constexpr std::int64_t kClockWrap_us = hesai::kClockWrap_us;

  HesaiSensor(const typename Table::Calibration& calibration, const mount::Mount& mount,
              const Config& config)
      : Table(calibration, mount), follows_firing_(config.follows_firing) {}

  [[nodiscard]] std::optional<frame::Reject> check(const packet::Datagram& datagram,
                                                   packet::PacketAzimuths& azimuths) noexcept
      TERRACUT_NONBLOCKING {
    return reader_.read(datagram.payload, azimuths);
  }
  [[nodiscard]] std::int32_t advance_ticks(std::int32_t step_ticks, std::size_t group,
                                           bool dual_return) const noexcept {
    if (!follows_firing_) return 0;
    if (step_ticks < kFast) return Table::advance_ticks(step_ticks, group, dual_return);
    constexpr std::int32_t kBlock_ns = Model::kLayout.column_ns / 2;
    return static_cast<std::int32_t>(std::int64_t{step_ticks - kFast} *
                                     (Model::group_ns(group) % kBlock_ns) / kBlock_ns);
  }
  /// Returns the step, plus kFast if blocks follow one another twice as fast: a laser then fires in
  /// either block as in its half of a slow one.
  [[nodiscard]] static std::int32_t step_ticks(const packet::PacketAzimuths& azimuths,
                                               std::size_t /*column*/) noexcept {
    const std::int32_t slow_ns =
        Model::kPace.column_ns * Model::kPace.firings(azimuths.dual_return);
    return azimuths.step_ticks + (azimuths.nominal_period_ns < slow_ns ? kFast : 0);
  }
  static void begin_packet(const packet::PacketAzimuths& /*azimuths*/) noexcept {}
  static void read_column(std::span<const std::uint8_t> payload, std::size_t column,
                          const typename Table::Returns& found) noexcept TERRACUT_NONBLOCKING {
    constexpr const PacketLayout& kLayout = Model::kLayout;
    const std::uint8_t* const first =
        payload.data() + kLayout.block_at(static_cast<int>(column)) + kLayout.returns_at();
    if constexpr (kLayout.return_bytes == packet::kWireReturnBytes) {
      packet::split_returns(first, packet::ByteOrder::kLittle, found.raw, &found.intensity[0]);
    } else {
      packet::split_wide_returns(first, found.raw, &found.intensity[0]);
    }
    if constexpr (kLayout.least_count > 1) {
      for (std::uint16_t& raw : found.raw) raw = raw < kLayout.least_count ? std::uint16_t{0} : raw;
    }
  }

 private:
  static constexpr std::int32_t kFast = 1 << 20;  ///< Above any step.

  PacketReader reader_{Model::kLayout};
  bool follows_firing_;
};

}  // namespace terracut::hesai
