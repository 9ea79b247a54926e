// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "calib/beams/angle.hpp"
#include "calib/ouster/ouster_geometry.hpp"
#include "calib/ouster/ouster_metadata.hpp"
#include "firmware_io/capture/pcap_writer.hpp"
#include "firmware_io/ouster/ouster_sensor.hpp"
#include "tools/lab/packets/group_azimuths.hpp"
#include "tools/lab/packets/labelled_return.hpp"
#include "tools/lab/packets/return_mode.hpp"

namespace terracut::packets {

/// An Ouster's ranges are made in counts of so much, of which 16 bits reach 131 m. Profiles of 15
/// bits round them to 8 mm.
inline constexpr int kOusterMillimetresPerCount = 2;

/// Writes the data packets of an Ouster in any profile into a capture, with the factory's port. Of
/// the packet's header only type and number of the frame are not zero. Writes a file, so it is not
/// real-time safe. One thread.
template <int kRows>
class OusterPacketSender {
 public:
  using Column = packets::LabelledColumn<kRows>;

  explicit OusterPacketSender(const ouster::OusterCalibration& unit) : unit_(unit) {}

  /// Writes the next packet; `columns` fill it. Fails with kInvalidArgument if they are not those
  /// of a packet: numbered on from a multiple of 16.
  [[nodiscard]] Status send(std::span<const Column> columns, int /*first_column*/,
                            capture::PcapWriter& capture) const {
    const ouster::PacketFormat& format = unit_.format;
    const ouster::Mode mode = ouster::mode_of(unit_);
    const std::size_t returns = format.is_dual() ? 2 : 1;
    std::vector<std::uint8_t> bytes(format.packet_bytes());
    const std::int64_t turn = columns.front().unwrapped_azimuth_cdeg / beams::kRevolution_cdeg;
    if (!format.is_legacy()) {
      bytes[0] = 1;
      put<2>(bytes, 2, static_cast<std::uint64_t>(turn));
    }
    for (std::size_t c = 0; c < columns.size(); c += returns) {
      const auto place = static_cast<int>(c / returns);
      const int number = ouster::measurement_at(beams::wrap_cdeg(columns[c].unwrapped_azimuth_cdeg),
                                                unit_.columns_per_frame);
      if (number % format.columns != place) {
        return fail(ErrorCode::kInvalidArgument, "columns of an Ouster begin amid a packet");
      }
      const std::size_t at = format.column_at(place);
      put<8>(bytes, at, static_cast<std::uint64_t>(columns[c].stamp_ns));
      put<2>(bytes, at + 8, static_cast<std::uint64_t>(number));
      if (format.is_legacy()) put<2>(bytes, at + 10, static_cast<std::uint64_t>(turn));
      put<2>(bytes, format.status_at(place), format.is_legacy() ? 0xFFFF : 1);
      for (std::size_t i = 0; i < returns; ++i) fill(columns[c + i], place, i == 1, bytes);
    }
    return capture.write({.payload = bytes,
                          .stamp_ns = columns.back().stamp_ns + mode.column_ns(),
                          .source_address = 0xC0A801C9,       // 192.168.1.201
                          .destination_address = 0xFFFFFFFF,  // broadcast
                          .source_port = ouster::kDataPort,
                          .destination_port = ouster::kDataPort});
  }

 private:
  template <std::size_t kBytes>
  static void put(std::span<std::uint8_t> bytes, std::size_t at, std::uint64_t value) noexcept {
    for (std::size_t i = 0; i < kBytes; ++i, value >>= 8) {
      bytes[at + i] = static_cast<std::uint8_t>(value & 0xFF);
    }
  }

  void fill(const Column& column, int place, bool is_second,
            std::span<std::uint8_t> bytes) const noexcept {
    const ouster::ProfileRow& row = ouster::row_of(unit_.format.profile);
    std::size_t at = unit_.format.channels_at(place) + (is_second ? row.second_at : 0);
    for (const LabelledReturn& beam : column.by_laser) {
      const int range_mm = beam.raw * kOusterMillimetresPerCount;
      const int rounded = (range_mm + row.range_mm / 2) / row.range_mm;
      const auto counts = static_cast<std::uint64_t>(range_mm > 0 ? std::max(rounded, 1) : 0);
      if (row.range_bits > 16) {
        put<3>(bytes, at, counts);
      } else {
        put<2>(bytes, at, counts);
      }
      bytes[at + row.reflectivity_at] = beam.intensity;
      at += row.channel_bytes;
    }
  }

  ouster::OusterCalibration unit_;
};

/// An Ouster for makers of packets (packets/encoder_traits.hpp): 16 firings per packet. Its columns
/// are numbered, so that a unit in one of its modes fires where its table says.
template <int kRows>
struct OusterEncoderTraits {
  using Calibration = ouster::OusterCalibration;
  using Geometry = ouster::OusterGeometry;
  using Column = packets::LabelledColumn<kRows>;
  using Sender = OusterPacketSender<kRows>;

  struct Config {
    ReturnMode returns = ReturnMode::kSingle;
  };

  /// The beams' azimuths, minus the head's.
  class Offsets {
   public:
    explicit Offsets(const Calibration& unit) : ticks_(ouster::beam_ticks(unit)) {}
    [[nodiscard]] std::int32_t offset_ticks(int laser) const noexcept {
      return ticks_[static_cast<std::size_t>(laser)];
    }
    [[nodiscard]] std::int32_t hindmost_ticks() const noexcept {
      return *std::ranges::min_element(ticks_);
    }

   private:
    std::vector<std::int32_t> ticks_;
  };

  static constexpr int kLasers = kRows;
  static constexpr bool kStrongestFirst = true;
  static constexpr bool kSecondIsLast = false;
  /// Half of the 0.18 degrees that the data sheets give.
  static constexpr double kBeamHalfWidth_rad = 1.57e-3;
  static constexpr std::string_view kCalibrationSuffix = ".calibration.json";

  /// Returns the unit sending whole frames of single or dual returns, at its own rate if that is
  /// `spin_hz`, otherwise in the mode of the nearest rate: 4096 columns at 5 Hz, 1024 at 10 and 20.
  [[nodiscard]] static Calibration unit_in_mode(Calibration unit, ReturnMode returns,
                                                double spin_hz) {
    const bool is_dual = returns == ReturnMode::kDual;
    if (unit.format.is_dual() != is_dual) {
      unit.format.profile = is_dual ? ouster::Profile::kDual : ouster::Profile::kSingle;
    }
    unit.format.columns = ouster::kMostColumnsPerPacket;
    if (unit.rate_hz != spin_hz) {
      unit.rate_hz = spin_hz < 7.5 ? 5 : spin_hz < 15 ? 10 : 20;
      unit.columns_per_frame = unit.rate_hz < 10 ? 4096 : 1024;
    }
    unit.window = {0, unit.columns_per_frame - 1};
    return unit;
  }
  [[nodiscard]] static std::int64_t firing_ns(const Calibration& unit) noexcept {
    return ouster::mode_of(unit).column_ns();
  }
  [[nodiscard]] static int columns_per_frame(ReturnMode returns, double spin_hz) {
    return unit_in_mode(nominal(), returns, spin_hz).columns_per_frame;
  }
  [[nodiscard]] static constexpr int firings_per_group(ReturnMode) noexcept {
    return ouster::kMostColumnsPerPacket;
  }
  [[nodiscard]] static constexpr int columns_per_packet(ReturnMode returns) noexcept {
    return ouster::kMostColumnsPerPacket * returns_per_firing(returns);
  }
  [[nodiscard]] static std::int64_t numbered_cdeg(const Calibration& unit,
                                                  std::int64_t number) noexcept {
    const std::int64_t columns = unit.columns_per_frame;
    const std::int64_t turn = number / columns - (number % columns < 0 ? 1 : 0);
    const std::int32_t ticks = ouster::measurement_ticks(static_cast<int>(number - turn * columns),
                                                         unit.columns_per_frame);
    return turn * beams::kRevolution_cdeg + ticks / packet::kTicksPerCdeg;
  }

  /// How far the head is past its azimuth as sent: that is in hundredths of a degree, which a
  /// column's is not. The columns of a frame show in the way of the head during a packet.
  [[nodiscard]] static std::int32_t step_ticks(const GroupAzimuths& rotor, int place,
                                               ReturnMode) noexcept {
    constexpr int kSteps = ouster::kMostColumnsPerPacket - 1;
    const double way_cdeg = beams::step_cdeg(rotor.cdeg[0], rotor.cdeg[kSteps]);
    const auto off = [&](int columns) {
      return std::abs(beams::kRevolution_cdeg * kSteps / way_cdeg - columns);
    };
    const int columns = *std::ranges::min_element(ouster::kColumnsPerFrame, {}, off);
    return ouster::rest_ticks(rotor.cdeg[static_cast<std::size_t>(place)], columns);
  }
  [[nodiscard]] static constexpr std::int32_t advance_ticks(std::int32_t rest_ticks, int,
                                                            ReturnMode) noexcept {
    return rest_ticks;
  }
  [[nodiscard]] static std::int32_t offset_ticks(const Offsets& offsets, std::int32_t rest_ticks,
                                                 int laser, ReturnMode) noexcept {
    return offsets.offset_ticks(laser) + rest_ticks;
  }

  [[nodiscard]] static Offsets offsets(const Calibration& unit) { return Offsets(unit); }
  [[nodiscard]] static Geometry geometry(const Calibration& unit, const Config&) {
    return {unit, metres_per_count(unit)};
  }
  [[nodiscard]] static Expected<Sender> sender(const Calibration& unit, const Config& config) {
    if (unit.format.is_dual() != (config.returns == ReturnMode::kDual)) {
      return fail(ErrorCode::kInvalidArgument, "the unit sends another number of returns");
    }
    return Sender(unit);
  }
  [[nodiscard]] static Calibration nominal() {
    return ouster::nominal_ouster(ouster::model_of_rows(kRows));
  }
  [[nodiscard]] static constexpr double metres_per_count(const Calibration&) noexcept {
    return kOusterMillimetresPerCount * 1e-3;
  }
  [[nodiscard]] static double widest_offset_rad(const Calibration& unit) noexcept {
    double widest_rad = 0;
    for (const beams::TableBeam& laser : unit.lasers) {
      widest_rad = std::max(widest_rad, std::abs(laser.azimuth_offset_rad));
    }
    return widest_rad;
  }

  [[nodiscard]] static Status write_calibration(const std::filesystem::path& path,
                                                const Calibration& unit) {
    return ouster::write_ouster_metadata(path, unit);
  }
  [[nodiscard]] static Expected<Calibration> read_calibration(const std::filesystem::path& path) {
    return ouster::read_ouster_metadata(path, ouster::model_of_rows(kRows));
  }
};

}  // namespace terracut::packets
