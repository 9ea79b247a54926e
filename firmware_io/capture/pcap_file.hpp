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

/// One record of a capture file.
struct PcapRecord {
  /// The record, beginning with its link-layer header; valid until the next record.
  std::span<const std::uint8_t> bytes;
  std::int64_t stamp_ns = 0;  ///< Nanoseconds since 1970 (UTC), from 0 to the year 2255.
};

/// Reads the records of a capture file (pcap with micro- or nanosecond stamps in either byte order,
/// or pcapng) in file order, whatever they hold. Not thread-safe; blocks on the disk.
class PcapFile {
 public:
  /// Opens the file. Fails with kNotFound, kUnreadable, or kMalformed (an empty file or no capture;
  /// the message says what it looks like).
  [[nodiscard]] static Expected<PcapFile> open(std::filesystem::path path);

  /// Reads from memory, which must outlive this object; `name` stands for the path in messages.
  [[nodiscard]] static Expected<PcapFile> open_memory(std::span<const std::uint8_t> capture,
                                                      std::string name);

  /// Returns the next record; nothing at the end.
  ///
  /// Fails with kMalformed (or kUnsupported for interfaces of different link types in one pcapng)
  /// if the file breaks off: the message says after which packet and at which byte, and every
  /// further call fails in the same way. Allocates nothing per record.
  [[nodiscard]] Expected<std::optional<PcapRecord>> next();

  /// Goes back to the first record, by opening the file again.
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
  std::filesystem::path path_;  ///< Empty if the capture is read from memory.
  std::span<const std::uint8_t> memory_;
  std::unique_ptr<::pcap, Close> handle_;
  int link_type_ = 0;
  std::uint64_t records_this_pass_ = 0;
  bool is_at_end_ = false;
  std::optional<Error> break_off_;
};

}  // namespace terracut::capture
