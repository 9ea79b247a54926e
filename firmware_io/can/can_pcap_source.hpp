// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "firmware_io/can/can_frame.hpp"
#include "firmware_io/can/can_log_counters.hpp"
#include "firmware_io/capture/pcap_file.hpp"
#include "rt/error.hpp"

namespace terracut::can {

/// Reads CAN frames from a capture file, in file order. The capture is of one CAN interface (link
/// type 227) or of all interfaces ("cooked", 113 and 276); frames of other protocols are skipped. A
/// capture does not say which bus a frame was on. Not thread-safe; blocks on the disk.
class CanPcapSource {
 public:
  /// Opens the file. Fails as PcapFile::open() does, and with kUnsupported for a capture of any
  /// other link type.
  [[nodiscard]] static Expected<CanPcapSource> open(std::filesystem::path path);

  /// Reads from memory, which must outlive the source; `name` stands for the path in messages.
  [[nodiscard]] static Expected<CanPcapSource> open_memory(std::span<const std::uint8_t> capture,
                                                           std::string name);

  /// Returns the next frame; nothing at the end. Records without a frame are counted and skipped.
  /// Fails if the file breaks off (see PcapFile::next()).
  [[nodiscard]] Expected<std::optional<CanFrame>> next();

  [[nodiscard]] const CanLogCounters& counters() const noexcept { return counters_; }
  /// Describes the first malformed record, "drive.pcap: record 12: ..."; empty if there was none.
  [[nodiscard]] const std::string& first_fault() const noexcept { return first_fault_; }
  [[nodiscard]] const std::string& name() const noexcept { return file_.name(); }

 private:
  explicit CanPcapSource(capture::PcapFile file) : file_(std::move(file)) {}
  [[nodiscard]] static Expected<CanPcapSource> over(Expected<capture::PcapFile> file);

  capture::PcapFile file_;
  CanLogCounters counters_;
  std::string first_fault_;
};

}  // namespace terracut::can
