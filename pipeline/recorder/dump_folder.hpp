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

/// The limits of the disk space for dumps.
struct DumpFolderLimits {
  std::filesystem::path folder;                 ///< Folder of the dumps; made if missing.
  std::string name = "terracut";                ///< Start of our dumps' names; see is_dump_name().
  std::size_t most_dumps = 20;                  ///< Most dumps of this name kept, [1, ...).
  std::uint64_t most_bytes = 2ULL << 30;        ///< Most bytes of all these dumps together.
  std::uint64_t least_free_bytes = 1ULL << 30;  ///< Least space left free on the file system.
};

/// True for 1 to 64 letters, digits, '_', '-' and '.', as in names of status pages: the name
/// becomes part of file names.
[[nodiscard]] bool is_dump_name(std::string_view name) noexcept;

/// The folder in which a recorder keeps its dumps: names dumps, and makes room by deleting the
/// oldest. It touches only files of its own: plain files called
/// `NAME-SERIAL-YYYYMMDDTHHMMSS.mmmZ-REASON.pcap`, the `.frames.json` and the unit's
/// `.calibration.xml` or `.csv` beside such a file, and parts of these that a killed process left
/// (`...part-PID-N`). The oldest dump is the one with the lowest serial number, whatever its time;
/// dumps of earlier versions, without a number, are older than all others.
///
/// For one thread without a deadline: blocks on the disk.
class DumpFolder {
 public:
  /// Throws std::invalid_argument for an invalid name or a limit out of range.
  explicit DumpFolder(DumpFolderLimits limits);

  /// Makes room for a dump whose files have `bytes` together, and returns the path for its capture.
  /// Deletes old dumps as the limits require, but only if the new dump can then be written: a
  /// failure with kOverQuota, kDiskLow or kFolderUnusable deletes nothing.
  [[nodiscard]] tl::expected<std::filesystem::path, RefusedDump> make_room(std::uint64_t bytes,
                                                                           DumpReason reason,
                                                                           std::int64_t now_ns);

  /// Checks that dumps can be written to the folder, made if missing. Fails with kFolderUnusable.
  [[nodiscard]] tl::expected<void, RefusedDump> check() const;

  /// Returns how many old dumps make_room() has deleted since construction.
  [[nodiscard]] std::uint64_t deleted() const noexcept { return deleted_; }
  [[nodiscard]] const DumpFolderLimits& limits() const noexcept { return limits_; }

 private:
  DumpFolderLimits limits_;
  std::uint64_t deleted_ = 0;
  std::uint64_t newest_serial_ = 0;  ///< The last serial number given.
};

/// Returns the path of the JSON file that belongs to the capture of a dump.
[[nodiscard]] std::filesystem::path frame_times_path(const std::filesystem::path& capture);
/// Returns the path of the unit's calibration table that belongs to `capture`; `suffix` is the
/// ending for the sensor's tables, such as ".calibration.xml".
[[nodiscard]] std::filesystem::path dump_calibration_path(const std::filesystem::path& capture,
                                                          std::string_view suffix);

}  // namespace terracut::recorder
