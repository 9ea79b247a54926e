// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "firmware_io/can/can_frame.hpp"
#include "firmware_io/can/can_log_counters.hpp"
#include "firmware_io/can/can_pcap_source.hpp"
#include "firmware_io/can/candump_source.hpp"
#include "rt/error.hpp"

namespace terracut::can {

/// A recorded CAN bus: a candump log or a capture file, told apart by the first bytes. Not
/// thread-safe; blocks on the disk.
class CanRecording {
 public:
  /// Opens a recording. A log delivers only frames of `interface` (if empty, of any); a capture
  /// does not name interfaces. Fails as CandumpSource::open() or CanPcapSource::open() does.
  [[nodiscard]] static Expected<CanRecording> open(const std::filesystem::path& path,
                                                   std::string interface = {});

  /// Returns the next frame; nothing at the end. Fails as CandumpSource::next() or
  /// CanPcapSource::next() does.
  [[nodiscard]] Expected<std::optional<CanFrame>> next() {
    return std::visit([](auto& source) { return source.next(); }, source_);
  }

  [[nodiscard]] const CanLogCounters& counters() const noexcept {
    return std::visit([](const auto& source) -> auto& { return source.counters(); }, source_);
  }
  [[nodiscard]] const std::string& first_fault() const noexcept {
    return std::visit([](const auto& source) -> auto& { return source.first_fault(); }, source_);
  }

 private:
  explicit CanRecording(CandumpSource source) : source_(std::move(source)) {}
  explicit CanRecording(CanPcapSource source) : source_(std::move(source)) {}

  std::variant<CandumpSource, CanPcapSource> source_;
};

}  // namespace terracut::can
