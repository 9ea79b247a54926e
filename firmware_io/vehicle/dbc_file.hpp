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

/// How the bits of a signal encode a number.
enum class DbcNumber : std::uint8_t { kUnsigned, kSigned, kFloat, kDouble };

/// In which frames of a multiplexed message a signal is valid.
enum class DbcMultiplex : std::uint8_t {
  kAlways,
  kSelector,  ///< The signal is valid in all frames; its value selects the other signals.
  kSelected,  ///< The signal is valid in frames whose selector has a certain value.
};

/// A signal as stated in its SG_ line. Parsing checks only what this line alone can show.
struct DbcSignal {
  std::string name;
  int start_bit = 0;  ///< Bit n % 8 of byte n / 8; lowest bit if Intel, highest if Motorola.
  int bit_count = 0;
  bool motorola = false;  ///< Big endian: continues at bit 7 of the next byte.
  DbcNumber number = DbcNumber::kUnsigned;
  double factor = 1;  ///< value = bits * factor + offset
  double offset = 0;
  DbcMultiplex multiplex = DbcMultiplex::kAlways;
  std::string unit;
  int line = 0;  ///< Line of the file, from 1.
};

/// A message as stated in its BO_ line.
struct DbcMessage {
  std::string name;
  std::uint32_t written_id = 0;  ///< The id as written; bit 31 marks a 29-bit id.
  int length = 0;                ///< Data length in bytes.
  int line = 0;
  std::vector<DbcSignal> signals;

  /// Returns the id; nothing if the number fits neither format.
  [[nodiscard]] std::optional<can::CanId> id() const noexcept;
};

/// The parts of a DBC file that are used: messages (BO_), their signals (SG_) and which of those
/// are floating-point numbers (SIG_VALTYPE_). Other parts are skipped.
struct DbcFile {
  std::string name;  ///< Name of the file, for messages.
  std::vector<DbcMessage> messages;
};

/// A signal and its message.
struct DbcReference {
  const DbcMessage* message = nullptr;
  const DbcSignal* signal = nullptr;
};

/// Parses a DBC file; the text may be anything. Fails with kMalformed, naming the line, for a
/// broken BO_, SG_ or SIG_VALTYPE_ line, and for a text without any message. `name` stands for the
/// path in messages.
[[nodiscard]] Expected<DbcFile> parse_dbc(std::string_view text, std::string name);

/// Reads a file of at most 4 MiB. Fails with kNotFound, kUnreadable, kUnsupported (larger), or as
/// parse_dbc() does.
[[nodiscard]] Expected<DbcFile> read_dbc(const std::filesystem::path& path);

/// Returns the signal called "MESSAGE.SIGNAL", or "SIGNAL" if only one message has a signal of that
/// name. Points into `file`. Fails with kInvalidArgument if there is none, or several.
[[nodiscard]] Expected<DbcReference> find_signal(const DbcFile& file, std::string_view name);

}  // namespace terracut::vehicle
