// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware_io/can/can_frame.hpp"
#include "rt/error.hpp"

namespace terracut::vehicle {

/// How the bits of a signal are a number.
enum class DbcNumber : std::uint8_t { kUnsigned, kSigned, kFloat, kDouble };

/// Where a signal of a multiplexed message is valid.
enum class DbcMultiplex : std::uint8_t {
  kAlways,
  kSelector,  ///< Always there; its value says which of the others are.
  kSelected,  ///< Only in those frames whose selector has a certain value.
};

/// A signal as its SG_ line says; not checked beyond what the line itself needs.
struct DbcSignal {
  std::string name;
  int start_bit = 0;  ///< Bit n % 8 of byte n / 8: the lowest of an Intel, the highest of a
                      ///< Motorola signal.
  int bit_count = 0;
  bool motorola = false;  ///< Big endian: continues at bit 7 of the next byte.
  DbcNumber number = DbcNumber::kUnsigned;
  double factor = 1;  ///< value = bits * factor + offset
  double offset = 0;
  DbcMultiplex multiplex = DbcMultiplex::kAlways;
  std::string unit;
  int line = 0;  ///< Of the file, from 1.
};

/// A message as its BO_ line says.
struct DbcMessage {
  std::string name;
  std::uint32_t written_id = 0;  ///< Bit 31 stands for a 29-bit id.
  int length = 0;                ///< Bytes.
  int line = 0;
  std::vector<DbcSignal> signals;

  /// Nothing when the number fits neither format.
  [[nodiscard]] std::optional<can::CanId> id() const noexcept;
};

/// What terracut needs of a DBC file: messages (BO_), their signals (SG_) and which of those are
/// floating-point numbers (SIG_VALTYPE_). All else is stepped over.
struct DbcFile {
  std::string name;  ///< For messages.
  std::vector<DbcMessage> messages;
};

/// A signal and the message it is in.
struct DbcReference {
  const DbcMessage* message = nullptr;
  const DbcSignal* signal = nullptr;
};

/// Any bytes. kMalformed, with the line, for a BO_, SG_ or SIG_VALTYPE_ line that is not one, and
/// for a text without any message. `name` stands for the path in messages.
[[nodiscard]] Expected<DbcFile> parse_dbc(std::string_view text, std::string name);

/// A file of at most 4 MiB. kNotFound, kUnreadable, kUnsupported (larger), or as parse_dbc().
[[nodiscard]] Expected<DbcFile> read_dbc(const std::filesystem::path& path);

/// The signal called "MESSAGE.SIGNAL", or "SIGNAL" where only one message has one of that name. The
/// result points into `file`. kInvalidArgument: there is none, or there are several.
[[nodiscard]] Expected<DbcReference> find_signal(const DbcFile& file, std::string_view name);

}  // namespace terracut::vehicle
