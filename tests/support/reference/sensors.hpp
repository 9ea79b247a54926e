// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "firmware_io/decode/decoder.hpp"
#include "firmware_io/hdl64e/packet_check.hpp"
#include "firmware_io/ruby128/packet_check.hpp"
#include "hdl64e_reference.hpp"
#include "hesai_reference.hpp"
#include "robosense_reference.hpp"
#include "rotating_head.hpp"
#include "ruby128_reference.hpp"
#include "velodyne_reference.hpp"

/// Sensors under the same names, for tests and fuzzers that compare the product's decoder with
/// the reference and are the same for all.
namespace terracut::reference {

using PayloadBytes = std::vector<std::uint8_t>;

struct Hdl64e {
  using Decoder = decode::Decoder;
  using Calibration = hdl64e::Hdl64eCalibration;
  using Reference = Hdl64eReference;
  static constexpr int kColumns = 6, kLasers = 64;
  static constexpr int kFirstBlock = 0, kBlockBytes = 100, kBlocks = 12;

  static int columns(bool) { return kColumns; }
  static int columns_a_block() { return 1; }
  static double firing_us(bool dual_return) { return dual_return ? 57.6 : 48.0; }
  static double firings_per_packet(bool dual_return) { return dual_return ? 3 : 6; }
  static Calibration random_unit(std::mt19937& random) { return random_hdl64e(random); }
  static std::vector<double> elevations(const Calibration& calibration) {
    std::vector<double> elevations;
    for (const auto& laser : calibration.lasers) elevations.push_back(laser.vert_correction_rad);
    return elevations;
  }
  static std::vector<Payload> payloads(const RotatingHead& head) { return hdl64e_payloads(head); }
  static void set_azimuth(PayloadBytes& payload, int column, unsigned cdeg) {
    set_hdl64e_azimuth(payload, column, cdeg);
  }
  static void set_return(PayloadBytes& payload, int column, int laser, unsigned raw,
                         unsigned intensity) {
    set_hdl64e_return(payload, column, laser, raw, intensity);
  }
  static void set_clock(PayloadBytes& payload, std::int64_t time_ns) {
    set_hdl64e_clock(payload, time_ns);
  }
  static void reset(Reference&) {}
  static std::optional<frame::Reject> check(std::span<const std::uint8_t> payload,
                                            packet::PacketAzimuths& azimuths) {
    return hdl64e::check_hdl64e_packet(payload, azimuths);
  }
};

struct Ruby128 {
  using Decoder = decode::Decoder;
  using Calibration = ruby128::Ruby128Calibration;
  using Reference = Ruby128Reference;
  static constexpr int kColumns = 3, kLasers = 128;
  static constexpr int kFirstBlock = 80, kBlockBytes = 388, kBlocks = 3;

  static int columns(bool) { return kColumns; }
  static int columns_a_block() { return 1; }
  static double firing_us(bool) { return 55.55; }
  static double firings_per_packet(bool dual_return) { return dual_return ? 1.5 : 3; }
  static Calibration random_unit(std::mt19937& random) { return random_ruby128(random); }
  static std::vector<double> elevations(const Calibration& calibration) {
    std::vector<double> elevations;
    for (const auto& channel : calibration.channels) elevations.push_back(channel.elevation_rad);
    return elevations;
  }
  static std::vector<Payload> payloads(const RotatingHead& head) { return ruby128_payloads(head); }
  static void set_azimuth(PayloadBytes& payload, int column, unsigned cdeg) {
    set_ruby128_azimuth(payload, column, cdeg);
  }
  static void set_return(PayloadBytes& payload, int column, int laser, unsigned raw,
                         unsigned intensity) {
    set_ruby128_return(payload, column, laser, raw, intensity);
  }
  static void set_clock(PayloadBytes& payload, std::int64_t time_ns) {
    set_ruby128_clock(payload, time_ns, RubyClock::kMicroseconds);
  }
  static void reset(Reference& reference) { reference.reset(); }
  static std::optional<frame::Reject> check(std::span<const std::uint8_t> payload,
                                            packet::PacketAzimuths& azimuths) {
    return ruby128::check_ruby128_packet(payload, azimuths);
  }
};

/// Of Velodyne's smaller models.
template <class Model>
struct Velodyne {
  using Decoder = decode::Decoder;
  using Calibration = beams::BeamTable;
  using Reference = VelodyneReference;
  static constexpr int kLasers = Model::kLasers;
  static constexpr int kColumns = Model::kLayout.columns(false) * Model::kChannels / kLasers;
  static constexpr int kFirstBlock = 0, kBlockBytes = 100, kBlocks = 12;
  static constexpr int kImageColumns = Model::kLayout.columns(false);  ///< That a packet fills.

  static const VelodyneSheet& sheet() { return sheet_of(Model::kModel); }
  /// Of a packet; in dual return those of both blocks of a pair count.
  static int columns(bool dual_return) {
    return dual_return ? layout().columns(true) * Model::kChannels / kLasers : kColumns;
  }
  static int columns_a_block() { return sheet().firings_a_block; }
  static double firing_us(bool) { return sheet().firing_us; }
  static double firings_per_packet(bool dual_return) {
    return dual_return ? layout().pace.firings(true) * sheet().firings_a_block : kColumns;
  }
  static Calibration random_unit(std::mt19937& random) {
    return random_table(Model::kModel, random);
  }
  static std::vector<double> elevations(const Calibration& calibration) {
    return elevations_of(calibration.lasers);
  }
  static std::vector<Payload> payloads(const RotatingHead& head) {
    return velodyne_payloads(sheet(), head);
  }
  static void set_azimuth(PayloadBytes& payload, int column, unsigned cdeg) {
    set_velodyne_azimuth(sheet(), payload, column, cdeg);
  }
  static void set_return(PayloadBytes& payload, int column, int laser, unsigned raw,
                         unsigned intensity) {
    set_velodyne_return(sheet(), payload, column, laser, raw, intensity);
  }
  static void set_clock(PayloadBytes& payload, std::int64_t time_ns) {
    set_velodyne_clock(payload, time_ns);
  }
  static void reset(Reference&) {}
  static std::optional<frame::Reject> check(std::span<const std::uint8_t> payload,
                                            packet::PacketAzimuths& azimuths) {
    return velodyne::PacketReader(layout()).read(payload, azimuths);
  }
  static const velodyne::PacketLayout& layout() { return Model::kLayout; }
};
using Hdl32e = Velodyne<velodyne::Hdl32e>;
using Vlp32c = Velodyne<velodyne::Vlp32c>;
using Vls128 = Velodyne<velodyne::Vls128>;

/// Of Hesai's models; the OT128 and the Pandar128 also at high resolution.
template <class Model, bool kIsHigh = false>
struct Hesai {
  using Decoder = decode::Decoder;
  using Calibration = beams::BeamTable;
  using Reference = HesaiReference;
  static constexpr int kLasers = Model::kLasers, kColumns = Model::kLayout.blocks;
  static constexpr int kFirstBlock = static_cast<int>(Model::kLayout.header_bytes);
  static constexpr int kBlockBytes = static_cast<int>(Model::kLayout.block_at(1)) - kFirstBlock;
  static constexpr int kBlocks = Model::kLayout.blocks, kImageColumns = kBlocks;

  static const HesaiSheet& sheet() { return hesai_sheet_of(Model::kModel, kIsHigh); }
  static int columns(bool) { return kColumns; }
  static int columns_a_block() { return 1; }
  static double firing_us(bool) { return sheet().block_us; }
  static double firings_per_packet(bool dual_return) {
    return static_cast<double>(sheet().blocks) / (dual_return ? 2 : 1);
  }
  static Calibration random_unit(std::mt19937& random) {
    return random_table(Model::kModel, random);
  }
  static std::vector<double> elevations(const Calibration& calibration) {
    return elevations_of(calibration.lasers);
  }
  static std::vector<Payload> payloads(const RotatingHead& head) {
    return hesai_payloads(sheet(), head);
  }
  static void set_azimuth(PayloadBytes& payload, int column, unsigned cdeg) {
    set_hesai_azimuth(sheet(), payload, column, cdeg);
  }
  static void set_return(PayloadBytes& payload, int column, int laser, unsigned raw,
                         unsigned intensity) {
    set_hesai_return(sheet(), payload, column, laser, raw, intensity);
  }
  static void set_clock(PayloadBytes& payload, std::int64_t time_ns) {
    set_hesai_clock(sheet(), payload, time_ns);
  }
  static void reset(Reference&) {}
};

/// Of RoboSense's models with 32 lasers.
template <class Model>
struct RoboSense {
  using Decoder = decode::Decoder;
  using Calibration = beams::BeamTable;
  using Reference = RoboSenseReference;
  static constexpr int kLasers = 32, kColumns = 12, kImageColumns = kColumns;
  static constexpr int kFirstBlock = 42, kBlockBytes = 100, kBlocks = 12;

  static const RoboSenseSheet& sheet() { return robosense_sheet_of(Model::kModel); }
  static int columns(bool) { return kColumns; }
  static int columns_a_block() { return 1; }
  static double firing_us(bool) { return sheet().block_us; }
  static double firings_per_packet(bool dual_return) { return dual_return ? 6 : 12; }
  static Calibration random_unit(std::mt19937& random) {
    return random_table(Model::kModel, random);
  }
  static std::vector<double> elevations(const Calibration& calibration) {
    return elevations_of(calibration.lasers);
  }
  static std::vector<Payload> payloads(const RotatingHead& head) {
    return robosense_payloads(sheet(), head);
  }
  static PayloadBytes device_payload() {
    return robosense_device_payload(beams::built_in_table(Model::kModel));
  }
  static void set_azimuth(PayloadBytes& payload, int column, unsigned cdeg) {
    set_robosense_azimuth(payload, column, cdeg);
  }
  static void set_return(PayloadBytes& payload, int column, int laser, unsigned raw,
                         unsigned intensity) {
    set_robosense_return(payload, column, laser, raw, intensity);
  }
  static void set_clock(PayloadBytes& payload, std::int64_t time_ns) {
    set_robosense_clock(sheet(), payload, time_ns);
  }
  static void reset(Reference&) {}
};

/// Takes the returns off whose beam is so near a seam that it may be of either frame.
template <class Sensor>
void erase_returns_on_the_seam(PayloadBytes& payload, const Packet& packet) {
  for (const Return& beam : packet.returns) {
    if (seam_distance_deg(beam.beam_deg) < kBorder_deg) {
      Sensor::set_return(payload, beam.column, beam.laser, 0, 0);
    }
  }
}

}  // namespace terracut::reference
