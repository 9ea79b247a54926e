// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "pipeline/recorder/dump_record.hpp"

namespace terracut::recorder {

/// How much disk the dumps may take.
struct DumpFolderLimits {
  std::filesystem::path folder;           ///< Made if missing.
  std::string name = "terracut";          ///< Begins the names of our dumps; see is_dump_name().
  std::size_t most_dumps = 20;            ///< Our dumps kept, [1, ...).
  std::uint64_t most_bytes = 2ULL << 30;  ///< For all our dumps together.
  std::uint64_t least_free_bytes = 1ULL << 30;  ///< Left free for others on that file system.
};

/// True for 1 to 64 letters, digits, '_', '-' and '.', as for status pages: it becomes part of file
/// names.
[[nodiscard]] bool is_dump_name(std::string_view name) noexcept;

/// The folder in which a recorder keeps its dumps: names them, and makes room by deleting the
/// oldest. It touches only its own: plain files called
/// `NAME-SERIAL-YYYYMMDDTHHMMSS.mmmZ-REASON.pcap`, the `.frames.json` and the unit's
/// `.calibration.xml` or `.csv` beside it, and parts of these that a killed process left
/// (`...part-PID-N`). The oldest dump has the lowest serial number, whatever the clock said; dumps
/// of earlier versions, without a number, are older than all others.
///
/// One thread; blocks on the disk: not for real-time threads.
class DumpFolder {
 public:
  /// std::invalid_argument for a bad name or a limit out of its range.
  explicit DumpFolder(DumpFolderLimits limits);

  /// Makes room for a dump of `bytes` (both files) and returns the path of its capture. Deletes old
  /// dumps as the limits require, but only if the new one can then be written: kOverQuota, kDiskLow
  /// and kFolderUnusable change nothing.
  [[nodiscard]] tl::expected<std::filesystem::path, RefusedDump> make_room(std::uint64_t bytes,
                                                                           DumpReason reason,
                                                                           std::int64_t now_ns);

  /// Checks that dumps can be written there; makes the folder if missing. kFolderUnusable.
  [[nodiscard]] tl::expected<void, RefusedDump> check() const;

  /// Returns how many old dumps make_room() has deleted since construction.
  [[nodiscard]] std::uint64_t deleted() const noexcept { return deleted_; }
  [[nodiscard]] const DumpFolderLimits& limits() const noexcept { return limits_; }

 private:
  DumpFolderLimits limits_;
  std::uint64_t deleted_ = 0;
  std::uint64_t newest_serial_ = 0;  ///< The last serial number given.
};

/// Returns the path of the JSON file of a dump's capture.
[[nodiscard]] std::filesystem::path frame_times_path(const std::filesystem::path& capture);
/// Returns the path of the unit's table beside it; `suffix` is that of the sensor's drives, such as
/// ".calibration.xml".
[[nodiscard]] std::filesystem::path dump_calibration_path(const std::filesystem::path& capture,
                                                          std::string_view suffix);

}  // namespace terracut::recorder
