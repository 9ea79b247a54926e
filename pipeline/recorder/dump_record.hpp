// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace terracut::recorder {

/// The event that led to a dump.
enum class DumpReason : std::uint8_t {
  kMissedDeadline,  ///< A frame's labels were late.
  kAsked,           ///< A person or program asked: `terracut dump`, SIGUSR1.
};
inline constexpr std::size_t kDumpReasons = 2;

/// Returns "missed_deadline" or "asked", for file names and JSON.
[[nodiscard]] constexpr std::string_view to_string(DumpReason reason) noexcept {
  return reason == DumpReason::kMissedDeadline ? "missed_deadline" : "asked";
}

/// Why a dump was refused.
enum class DumpRefusal : std::uint8_t {
  kTooSoon,         ///< The rate limit for dumps of this reason was reached.
  kNothingHeld,     ///< No datagram has come yet (or all were overwritten).
  kOverQuota,       ///< The dump alone is larger than the folder's quota.
  kDiskLow,         ///< Free space would fall below the limit.
  kFolderUnusable,  ///< The folder cannot be made, listed or asked for its free space.
  kWriteFailed,     ///< The disk failed during writing; no file was left.
  kNoRecorder,      ///< The process was told to keep no packets.
};
inline constexpr std::size_t kDumpRefusals = 7;

/// Returns a stable name such as "too_soon", for metrics and JSON.
[[nodiscard]] constexpr std::string_view to_string(DumpRefusal refusal) noexcept {
  constexpr std::array<std::string_view, kDumpRefusals> kNames{
      "too_soon",        "nothing_held", "over_quota", "disk_low",
      "folder_unusable", "write_failed", "no_recorder"};
  const auto index = static_cast<std::size_t>(refusal);
  return index < kNames.size() ? kNames[index] : "unknown";
}

/// A refusal with an explanation for people.
struct RefusedDump {
  DumpRefusal refusal;
  std::string message;
};

/// A dump that was written.
struct DumpReport {
  std::filesystem::path capture;      ///< The pcap file.
  std::filesystem::path frame_times;  ///< The JSON file beside it.
  std::filesystem::path calibration;  ///< The unit's table beside it; empty if none was written.
  std::uint64_t datagrams = 0;
  std::uint64_t overwritten = 0;  ///< Datagrams overwritten during the copy, so not in the file.
  std::uint64_t unwritable = 0;   ///< Datagrams left out, as a pcap cannot hold their stamp.
  std::int64_t first_stamp_ns = 0, last_stamp_ns = 0;  ///< Of the first and last datagram.
};

}  // namespace terracut::recorder
