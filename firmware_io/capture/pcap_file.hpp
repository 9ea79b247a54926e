// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "rt/error.hpp"

struct pcap;  // libpcap's handle, pcap_t

namespace terracut::capture {

/// One record of a capture file, as it was captured.
struct PcapRecord {
  std::span<const std::uint8_t> bytes;  ///< From the link layer on; valid until the next record.
  std::int64_t stamp_ns = 0;            ///< Since 1970 (UTC), [0, year 2255].
};

/// Reads the records of a capture file (pcap with micro- or nanosecond stamps in either byte order,
/// or pcapng) in file order, whatever they hold. Not thread-safe; blocks on the disk.
class PcapFile {
 public:
  /// Errors: kNotFound, kUnreadable or kMalformed (empty or no capture; the message says what it
  /// looks like).
  [[nodiscard]] static Expected<PcapFile> open(std::filesystem::path path);

  /// Reads from memory, which must outlive this object; `name` stands for the path in messages.
  [[nodiscard]] static Expected<PcapFile> open_memory(std::span<const std::uint8_t> capture,
                                                      std::string name);

  /// Returns the next record; nothing at the end.
  ///
  /// An error (kMalformed, or kUnsupported for interfaces of different link types in one pcapng)
  /// means that the file breaks off: the message says after which packet and at which byte, and
  /// every further call returns the same error. Allocates nothing a record.
  [[nodiscard]] Expected<std::optional<PcapRecord>> next();

  /// Goes back to the first record (a file is opened again).
  [[nodiscard]] Status rewind();

  [[nodiscard]] int link_type() const noexcept { return link_type_; }  ///< libpcap's DLT_ number.
  [[nodiscard]] std::string link_name() const;                         ///< "EN10MB (1)"
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

 private:
  struct Close {
    void operator()(::pcap* handle) const noexcept;
  };

  PcapFile() = default;
  [[nodiscard]] Status reopen();
  [[nodiscard]] Error broken_off(const char* reason);

  std::string name_;
  std::filesystem::path path_;  ///< Empty if reading from memory.
  std::span<const std::uint8_t> memory_;
  std::unique_ptr<::pcap, Close> handle_;
  int link_type_ = 0;
  std::uint64_t records_this_pass_ = 0;
  bool is_at_end_ = false;
  std::optional<Error> break_off_;
};

}  // namespace terracut::capture
