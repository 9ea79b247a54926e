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

/// How much disk dumps may take.
struct DumpFolderLimits {
  std::filesystem::path folder;           ///< Made when missing.
  std::string name = "terracut";          ///< Begins the names of own dumps; see is_dump_name().
  std::size_t most_dumps = 20;            ///< Own dumps kept, [1, ...).
  std::uint64_t most_bytes = 2ULL << 30;  ///< Of own dumps together.
  std::uint64_t least_free_bytes = 1ULL << 30;  ///< Left to others on that file system.
};

/// 1 to 64 letters, digits, '_', '-' and '.', as status pages are named: it becomes part of file
/// names.
[[nodiscard]] bool is_dump_name(std::string_view name) noexcept;

/// The folder a recorder keeps its dumps in: names them, and makes room for the next by deleting
/// the oldest of its own. Own are only plain files called
/// `NAME-SERIAL-YYYYMMDDTHHMMSS.mmmZ-REASON.pcap` and, beside it, `.frames.json` and the unit's
/// `.calibration.xml` or `.csv`, and what a killed process left of them (`...part-PID-N`); nothing
/// else is ever touched, whoever made it. The oldest is the one with the lowest serial number,
/// whatever the clock said; dumps of earlier versions, without one, are older than all others.
///
/// One thread; blocks on the disk, so never a real-time one.
class DumpFolder {
 public:
  /// std::invalid_argument for a bad name or a limit out of its range.
  explicit DumpFolder(DumpFolderLimits limits);

  /// Makes room for a dump of `bytes` (both files) and returns the path of its capture. Deletes old
  /// dumps as far as the limits ask for it, but only when the new one will then be allowed:
  /// kOverQuota, kDiskLow and kFolderUnusable leave everything as it was.
  [[nodiscard]] tl::expected<std::filesystem::path, RefusedDump> make_room(std::uint64_t bytes,
                                                                           DumpReason reason,
                                                                           std::int64_t now_ns);

  /// That dumps could be written there: made when missing. kFolderUnusable.
  [[nodiscard]] tl::expected<void, RefusedDump> check() const;

  /// Old dumps deleted by make_room(), since construction.
  [[nodiscard]] std::uint64_t deleted() const noexcept { return deleted_; }
  [[nodiscard]] const DumpFolderLimits& limits() const noexcept { return limits_; }

 private:
  DumpFolderLimits limits_;
  std::uint64_t deleted_ = 0;
  std::uint64_t newest_serial_ = 0;  ///< Given so far.
};

/// The JSON file that belongs to a dump's capture.
[[nodiscard]] std::filesystem::path frame_times_path(const std::filesystem::path& capture);
/// The unit's table beside it; `suffix` as the sensor's drives have it, ".calibration.xml" say.
[[nodiscard]] std::filesystem::path dump_calibration_path(const std::filesystem::path& capture,
                                                          std::string_view suffix);

}  // namespace terracut::recorder
