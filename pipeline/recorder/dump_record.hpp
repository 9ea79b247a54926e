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

/// Why a dump was wanted.
enum class DumpReason : std::uint8_t {
  kMissedDeadline,  ///< A frame's labels came too late.
  kAsked,           ///< A person or program asked: `terracut dump`, SIGUSR1.
};
inline constexpr std::size_t kDumpReasons = 2;

/// "missed_deadline", "asked": in file names and JSON.
[[nodiscard]] constexpr std::string_view to_string(DumpReason reason) noexcept {
  return reason == DumpReason::kMissedDeadline ? "missed_deadline" : "asked";
}

/// Why a dump that was wanted was not written.
enum class DumpRefusal : std::uint8_t {
  kTooSoon,         ///< The rate limit of its reason.
  kNothingHeld,     ///< No datagram has come yet (or all were overwritten meanwhile).
  kOverQuota,       ///< It alone is larger than the folder's quota.
  kDiskLow,         ///< Free space would fall under the floor.
  kFolderUnusable,  ///< The folder cannot be made, listed or asked for its free space.
  kWriteFailed,     ///< The disk refused while it was written; nothing was left.
  kNoRecorder,      ///< The process was told to keep no packets.
};
inline constexpr std::size_t kDumpRefusals = 7;

/// "too_soon" and so on: in metrics and JSON.
[[nodiscard]] constexpr std::string_view to_string(DumpRefusal refusal) noexcept {
  constexpr std::array<std::string_view, kDumpRefusals> kNames{
      "too_soon",        "nothing_held", "over_quota", "disk_low",
      "folder_unusable", "write_failed", "no_recorder"};
  const auto index = static_cast<std::size_t>(refusal);
  return index < kNames.size() ? kNames[index] : "unknown";
}

/// A refusal with what a person needs to know of it.
struct RefusedDump {
  DumpRefusal refusal;
  std::string message;
};

/// A dump that was written.
struct DumpReport {
  std::filesystem::path capture;      ///< The pcap file.
  std::filesystem::path frame_times;  ///< The JSON file beside it.
  std::filesystem::path calibration;  ///< The unit's table beside it; empty where none was written.
  std::uint64_t datagrams = 0;
  std::uint64_t overwritten = 0;  ///< Overwritten while they were copied, so not in the capture.
  std::uint64_t unwritable = 0;   ///< With a stamp that a pcap cannot hold; not in it either.
  std::int64_t first_stamp_ns = 0, last_stamp_ns = 0;  ///< Of its first and last datagram.
};

}  // namespace terracut::recorder
