// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "calib/beams/straight_geometry.hpp"
#include "calib/hesai/hesai_csv.hpp"
#include "calib/robosense/unit_table.hpp"
#include "firmware_io/table/beam_offsets.hpp"
#include "tools/lab/packets/group_azimuths.hpp"
#include "tools/lab/packets/hesai_packet_sender.hpp"
#include "tools/lab/packets/labelled_return.hpp"
#include "tools/lab/packets/return_mode.hpp"
#include "tools/lab/packets/robosense_packet_sender.hpp"
#include "tools/lab/packets/velodyne_packet_sender.hpp"

namespace terracut::packets {

/// A sensor with a beams::BeamTable for makers of packets (packets/encoder_traits.hpp). Here a
/// column is one firing of all lasers; in a VLP-16's packets it is two.
template <class Model, class PacketSender>
struct TableEncoderTraits {
  using Calibration = beams::BeamTable;
  using Geometry = beams::StraightGeometry;
  using Offsets = table::BeamOffsets<Model>;
  using Column = packets::LabelledColumn<Model::kChannels>;
  using Sender = PacketSender;

  struct Config {
    ReturnMode returns = ReturnMode::kSingle;
  };

  static constexpr int kLasers = Model::kChannels;
  static constexpr bool kStrongestFirst = false;
  static constexpr bool kSecondIsLast = true;
  /// Half of the 3 mrad that the manuals give.
  static constexpr double kBeamHalfWidth_rad = 1.5e-3;

  [[nodiscard]] static constexpr bool is_dual(ReturnMode returns) noexcept {
    return returns == ReturnMode::kDual;
  }
  [[nodiscard]] static constexpr std::int64_t firing_ns(ReturnMode) noexcept {
    return Model::kPace.column_ns;
  }
  [[nodiscard]] static constexpr std::int64_t laser_period_ns(ReturnMode) noexcept {
    return std::int64_t{Model::kPace.column_ns} * Model::kLasers / Model::kChannels;
  }
  [[nodiscard]] static constexpr int firings_per_group(ReturnMode returns) noexcept {
    return Model::kPace.firings(is_dual(returns));
  }
  [[nodiscard]] static constexpr int columns_per_packet(ReturnMode returns) noexcept {
    return firings_per_group(returns) * (is_dual(returns) ? 2 : 1);
  }

  /// A packet with one firing shows no step between firings: the decoder uses the step from the
  /// previous packet.
  [[nodiscard]] static constexpr std::int32_t step_ticks(const GroupAzimuths& rotor, int,
                                                         ReturnMode returns) noexcept {
    const int firings = firings_per_group(returns);
    if (firings > 1) {
      const auto last = static_cast<std::size_t>(firings - 1);
      return table::mean_step_ticks(beams::step_cdeg(rotor.cdeg[0], rotor.cdeg[last]), firings);
    }
    if (!rotor.before_cdeg) return Model::kPace.assumed_step_ticks();
    return beams::step_cdeg(*rotor.before_cdeg, rotor.cdeg[0]) * packet::kTicksPerCdeg;
  }
  [[nodiscard]] static constexpr std::int32_t advance_ticks(std::int32_t step_ticks, int channel,
                                                            ReturnMode) noexcept {
    return table::advance_ticks<Model>(step_ticks, Model::group(static_cast<std::size_t>(channel)));
  }
  [[nodiscard]] static std::int32_t offset_ticks(const Offsets& offsets, std::int32_t step_ticks,
                                                 int channel, ReturnMode) noexcept {
    return offsets.offset_ticks(step_ticks, channel);
  }

  [[nodiscard]] static Offsets offsets(const Calibration& calibration) {
    return Offsets(calibration);
  }
  [[nodiscard]] static Geometry geometry(const Calibration& calibration, const Config&) {
    return {calibration.lasers, Model::kMetresPerCount, table::lens_ahead_m<Model>()};
  }
  [[nodiscard]] static Expected<Sender> sender(const Calibration&, const Config& config) {
    return Sender(config.returns);
  }
  [[nodiscard]] static Calibration nominal() { return beams::built_in_table(Model::kModel); }
  [[nodiscard]] static constexpr double metres_per_count(const Calibration&) noexcept {
    return Model::kMetresPerCount;
  }
  [[nodiscard]] static double widest_offset_rad(const Calibration& calibration) noexcept {
    double widest_rad = 0;
    for (const beams::TableBeam& laser : calibration.lasers) {
      widest_rad = std::max(widest_rad, std::abs(laser.azimuth_offset_rad));
    }
    return widest_rad;
  }
};

/// A Velodyne, whose table the decoder has built in.
template <class Model>
struct VelodyneEncoderTraits : TableEncoderTraits<Model, VelodynePacketSender<Model>> {
  static constexpr std::string_view kCalibrationSuffix = "";
};

/// A Hesai, whose table is a file beside the packets.
template <class Model>
struct HesaiEncoderTraits : TableEncoderTraits<Model, HesaiPacketSender<Model>> {
  static constexpr std::string_view kCalibrationSuffix = ".calibration.csv";
  [[nodiscard]] static Status write_calibration(const std::filesystem::path& path,
                                                const beams::BeamTable& table) {
    return hesai::write_hesai_csv(path, table);
  }
  [[nodiscard]] static Expected<beams::BeamTable> read_calibration(
      const std::filesystem::path& path) {
    return hesai::read_hesai_csv(path, Model::kModel);
  }
};

/// A RoboSense with 32 lasers, whose table is in its DIFOP packets and in a file.
template <class Model>
struct RoboSenseEncoderTraits : TableEncoderTraits<Model, RoboSensePacketSender<Model>> {
  using Table = TableEncoderTraits<Model, RoboSensePacketSender<Model>>;

  static constexpr bool kStrongestFirst = true;
  static constexpr bool kSecondIsLast = false;
  static constexpr std::string_view kCalibrationSuffix = ".calibration.csv";
  [[nodiscard]] static Expected<typename Table::Sender> sender(
      const beams::BeamTable& table, const typename Table::Config& config) {
    return typename Table::Sender(table, config.returns);
  }
  [[nodiscard]] static Status write_calibration(const std::filesystem::path& path,
                                                const beams::BeamTable& table) {
    return robosense::write_unit_csv(path, table);
  }
  [[nodiscard]] static Expected<beams::BeamTable> read_calibration(
      const std::filesystem::path& path) {
    return robosense::read_unit_csv(path, Model::kModel);
  }
};

}  // namespace terracut::packets
