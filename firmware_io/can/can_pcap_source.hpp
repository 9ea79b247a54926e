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

/// Frames of a CAN bus in a capture file, in file order: of a CAN interface (link type 227), or of
/// all interfaces ("cooked", 113 and 276), where other protocols are stepped over. Such a capture
/// does not say which bus a frame was on. Not thread-safe; blocks on the disk.
class CanPcapSource {
 public:
  /// Errors as PcapFile::open, and kUnsupported for a capture of another link layer.
  [[nodiscard]] static Expected<CanPcapSource> open(std::filesystem::path path);

  /// The same from memory, which must outlive the source; `name` stands for the path in messages.
  [[nodiscard]] static Expected<CanPcapSource> open_memory(std::span<const std::uint8_t> capture,
                                                           std::string name);

  /// The next frame; nothing at the end. Records that are no frame are counted and stepped over.
  /// An error means that the file breaks off, see PcapFile::next().
  [[nodiscard]] Expected<std::optional<CanFrame>> next();

  [[nodiscard]] const CanLogCounters& counters() const noexcept { return counters_; }
  /// "drive.pcap: record 12: ..." of the first malformed record; empty: none was.
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
