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

/// Keeps a report's frames[] on the disk during the run: an hour's 36,000 entries would take 200 MB
/// of memory. The file has no name, so it vanishes with the process. One thread.
class FrameEntries {
 public:
  /// Keeps the entries on the disk on which the file `report` will be. Errors are reported by
  /// write().
  explicit FrameEntries(const std::filesystem::path& report);

  void add(const nlohmann::ordered_json& entry);

  /// Writes `report`, with these entries in its list "frames", which must be empty; whole or not at
  /// all. Fails with kWriteFailed.
  [[nodiscard]] Status write(const std::filesystem::path& path,
                             const nlohmann::ordered_json& report);

 private:
  void flush();

  files::OwnedDescriptor file_;
  std::string pending_;  ///< Text not yet written to the file.
  std::uint64_t bytes_ = 0;
  int error_number_ = 0;  ///< errno of the first error; 0: none.
};

}  // namespace terracut::cli
