// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::files {

/// Claims an output for one run. Nobody else can claim the output while this object lives or until
/// its process dies, however it dies. Missing folders are made at once, so that obstacles show
/// before the work; those still empty at the end are removed. On file systems without locks,
/// nothing is claimed. Movable; start-up only.
class OutputClaim {
 public:
  /// Fails with kInvalidArgument if another run is writing the file, kWriteFailed (with the
  /// system's reason) if the file cannot be claimed.
  [[nodiscard]] static Expected<OutputClaim> of_file(const std::filesystem::path& path);
  enum class Use : std::uint8_t { kAlone, kShared };
  /// Claims the files in a folder, which is made if missing. With kShared, other runs that ask for
  /// kShared may claim the same folder at the same time. Fails as of_file() does.
  [[nodiscard]] static Expected<OutputClaim> of_folder(const std::filesystem::path& path,
                                                       Use use = Use::kAlone);

  OutputClaim(OutputClaim&&) noexcept = default;
  OutputClaim& operator=(OutputClaim&&) = delete;
  ~OutputClaim();

 private:
  OutputClaim() = default;
  [[nodiscard]] Status make_folders(const std::filesystem::path& folder);

  std::vector<std::filesystem::path> made_;  ///< The folders that this claim made, outermost first.
  std::filesystem::path lock_file_;          ///< The lock file, beside the claimed file.
  OwnedDescriptor lock_;
};

}  // namespace terracut::files
