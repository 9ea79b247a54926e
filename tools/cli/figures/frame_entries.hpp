// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::cli {

/// frames[] of a report, kept on the disk while its run goes on: of an hour's 36,000 frames they
/// would take 200 MB of memory. The file has no name, so that nothing of it is left. One thread.
class FrameEntries {
 public:
  /// Keeps them beside `report`, the file that they will be written to. An error is told by
  /// write().
  explicit FrameEntries(const std::filesystem::path& report);

  void add(const nlohmann::ordered_json& entry);

  /// Writes `report` with its "frames", an empty list so far, filled by these; whole or not at all.
  /// kWriteFailed.
  [[nodiscard]] Status write(const std::filesystem::path& path,
                             const nlohmann::ordered_json& report);

 private:
  void flush();

  files::OwnedDescriptor file_;
  std::string pending_;  ///< Not in the file yet.
  std::uint64_t bytes_ = 0;
  int error_number_ = 0;  ///< The first.
};

}  // namespace terracut::cli
