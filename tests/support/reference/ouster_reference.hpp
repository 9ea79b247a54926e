// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "calib/ouster/ouster_calibration.hpp"
#include "reference_return.hpp"
#include "rotating_head.hpp"

namespace terracut::reference {

/// Where a field of a measurement stands, in bits from its first: (value & mask) << shift of the
/// little-endian number of 32 bits that begins at `byte`, `from_bit` bits up.
struct OusterField {
  std::string name;
  int from_bit = 0, bits = 0;
  int shift = 0;  ///< To the left, of what is sent without its lowest bits.
  int bytes = 4;  ///< Of the number that it is decoded to.
};

/// What the maker's documentation says of a profile: sizes in bytes.
struct OusterSheet {
  ouster::Profile profile{};
  int packet_header = 0, column_header = 0, channel = 0, column_footer = 0, packet_footer = 0;
  bool is_dual = false;
  std::vector<OusterField> fields;

  [[nodiscard]] std::optional<OusterField> find(const std::string& name) const;
  /// For a name that the profile has.
  [[nodiscard]] const OusterField& field(const std::string& name) const;
  [[nodiscard]] int column_bytes(int rows) const {
    return column_header + rows * channel + column_footer;
  }
  [[nodiscard]] int packet_bytes(int rows, int columns) const {
    return packet_header + columns * column_bytes(rows) + packet_footer;
  }
  [[nodiscard]] int column_at(int rows, int column) const {
    return packet_header + column * column_bytes(rows);
  }
  [[nodiscard]] int channel_at(int rows, int column, int row) const {
    return column_at(rows, column) + column_header + row * channel;
  }
};
[[nodiscard]] const OusterSheet& ouster_sheet_of(ouster::Profile profile);

/// A plain, slow decoder of Ouster's data packets, written from the maker's documentation, byte by
/// byte and in double. It shares nothing with the product's decoder but the table's struct.
class OusterReference {
 public:
  explicit OusterReference(const ouster::OusterCalibration& unit)
      : unit_(unit), sheet_(ouster_sheet_of(unit.format.profile)) {}

  [[nodiscard]] Packet decode(std::span<const std::uint8_t> payload) const;

  /// Every field of a packet by its name in the maker's software, as the bytes that it is decoded
  /// to: heads of columns column by column (0 where a profile's columns do not have it), fields of
  /// measurements row by row.
  [[nodiscard]] std::map<std::string, std::string> fields(
      std::span<const std::uint8_t> payload) const;

 private:
  struct Column {
    std::uint64_t stamp_ns;
    int measurement;
    std::uint32_t status;
    std::uint32_t frame, encoder;
  };
  [[nodiscard]] Column column(std::span<const std::uint8_t> payload, int number) const;
  [[nodiscard]] std::uint64_t value(std::span<const std::uint8_t> payload, int column, int row,
                                    const OusterField& field) const;
  /// The maker's projection of a range in millimetres, into the unit's frame, metres.
  void project(double range_mm, int measurement, std::size_t row, Return& to) const;

  ouster::OusterCalibration unit_;
  OusterSheet sheet_;
};

/// Data packets, byte by byte as the documentation describes them; the head's rate is the unit's.
/// Of two returns, a fifth have the second.
[[nodiscard]] std::vector<Payload> ouster_payloads(const ouster::OusterCalibration& unit,
                                                   const RotatingHead& head);
/// Any unit of so many rows: profile, mode, angles and lengths within the spans of real ones.
[[nodiscard]] ouster::OusterCalibration random_ouster(int rows, ouster::Profile profile,
                                                      std::mt19937& random);
/// Numbers a packet's columns from `first` on, and says which of them are valid.
void set_ouster_columns(const ouster::OusterCalibration& unit, std::vector<std::uint8_t>& payload,
                        int first, std::uint64_t stamp_ns, std::uint32_t valid = ~0U);

}  // namespace terracut::reference
