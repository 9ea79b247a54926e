// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::files {

/// Claims an output for one run. Nobody else can claim it while this lives or until its process
/// dies, however it dies. Makes missing folders at once, so that obstacles show before the work;
/// those still empty at the end are removed. Does nothing on file systems without locks. Movable;
/// start-up only.
class OutputClaim {
 public:
  /// Errors: kInvalidArgument, another run is writing it; kWriteFailed with the system's reason.
  [[nodiscard]] static Expected<OutputClaim> of_file(const std::filesystem::path& path);
  enum class Use : std::uint8_t { kAlone, kShared };
  /// Claims the files in a folder, made if missing. kShared: others with kShared may hold it too.
  /// Errors as of_file().
  [[nodiscard]] static Expected<OutputClaim> of_folder(const std::filesystem::path& path,
                                                       Use use = Use::kAlone);

  OutputClaim(OutputClaim&&) noexcept = default;
  OutputClaim& operator=(OutputClaim&&) = delete;
  ~OutputClaim();

 private:
  OutputClaim() = default;
  [[nodiscard]] Status make_folders(const std::filesystem::path& folder);

  std::vector<std::filesystem::path> made_;  ///< Folders, outermost first.
  std::filesystem::path lock_file_;          ///< Lies beside the file that is claimed.
  OwnedDescriptor lock_;
};

}  // namespace terracut::files
