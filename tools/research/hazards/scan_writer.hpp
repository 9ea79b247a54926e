// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "calib/mount/mount.hpp"
#include "moved_return.hpp"
#include "rt/error.hpp"

namespace terracut::hazards {

struct LabelledFrame;

/// The description of a written scan.
struct WrittenScan {
  std::string sequence{}, name{};
  std::string what{};           ///< Word of the hazard or disturbance; empty: the frame as it was.
  std::string ground{};         ///< to_string(GroundKind) of a hazard; otherwise empty.
  double from_m = 0, to_m = 0;  ///< Range bin of a hazard.
};

/// Writes frames with hazards and disturbances as a dataset in SemanticKITTI's layout:
/// sequences/SEQUENCE/velodyne/NAME.bin and labels/NAME.label, ring after ring from the top.
/// Returns that count have class 99 (other-object) and instance 1, other moved returns class 0. All
/// other returns keep their class, with instance 0. For any thread.
class ScanWriter {
 public:
  explicit ScanWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void write(const WrittenScan& scan, const LabelledFrame& frame, const mount::Mount& mount,
             const MovedReturns& moved);

  /// Writes hazards.json: scans[] {sequence, scan, what, ground, from_m, to_m}; the last three only
  /// for hazards. Returns the first failure of any write.
  [[nodiscard]] Status finish();

 private:
  std::filesystem::path folder_;
  std::mutex mutex_;                          ///< Guards the following members.
  std::map<std::string, WrittenScan> scans_;  ///< Keyed by SEQUENCE/NAME.
  std::optional<Error> failure_;
};

}  // namespace terracut::hazards
