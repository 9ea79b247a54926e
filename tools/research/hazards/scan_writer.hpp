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

/// What a scan shows.
struct WrittenScan {
  std::string sequence{}, name{};
  std::string what{};    ///< The word of a hazard or a disturbance; empty: nothing was put there.
  std::string ground{};  ///< Of a hazard: to_string(GroundKind); empty of everything else.
  double from_m = 0, to_m = 0;  ///< Of a hazard: its range bin.
};

/// Writes frames with what was put into them as a dataset in SemanticKITTI's layout, for other
/// programs: sequences/SEQUENCE/velodyne/NAME.bin and labels/NAME.label, ring after ring from the
/// top. Returns that count have class 99 (other-object) and instance 1, others that moved class 0;
/// all others keep their class, with instance 0. From any thread.
class ScanWriter {
 public:
  explicit ScanWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}

  void write(const WrittenScan& scan, const LabelledFrame& frame, const mount::Mount& mount,
             const MovedReturns& moved);

  /// Writes hazards.json: scans[] {sequence, scan, what, ground, from_m, to_m}, of which the last
  /// three are for hazards only. Returns the first failure of all.
  [[nodiscard]] Status finish();

 private:
  std::filesystem::path folder_;
  std::mutex mutex_;                          ///< Guards the following members.
  std::map<std::string, WrittenScan> scans_;  ///< By sequence and name.
  std::optional<Error> failure_;
};

}  // namespace terracut::hazards
