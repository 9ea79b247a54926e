// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "rt/error.hpp"
#include "rt/files/owned_descriptor.hpp"

namespace terracut::files {

/// An output of one run alone. While this lives, or until its process dies, however that happens,
/// nobody else can claim it. Makes missing folders, so that what stands in the way of writing is
/// known before the work; those still empty in the end go again. Where a file system has no locks
/// nothing is held. Movable; start-up only.
class OutputClaim {
 public:
  /// Errors: kInvalidArgument, another run is writing it; kWriteFailed with the system's reason.
  [[nodiscard]] static Expected<OutputClaim> of_file(const std::filesystem::path& path);
  enum class Use : std::uint8_t { kAlone, kShared };
  /// The files in it; made if missing. kShared: others may share it in turn. Errors as of_file().
  [[nodiscard]] static Expected<OutputClaim> of_folder(const std::filesystem::path& path,
                                                       Use use = Use::kAlone);

  OutputClaim(OutputClaim&&) noexcept = default;
  OutputClaim& operator=(OutputClaim&&) = delete;
  ~OutputClaim();

 private:
  OutputClaim() = default;
  [[nodiscard]] Status make_folders(const std::filesystem::path& folder);

  std::vector<std::filesystem::path> made_;  ///< Folders, outermost first.
  std::filesystem::path lock_file_;          ///< Of a file's claim, beside it.
  OwnedDescriptor lock_;
};

}  // namespace terracut::files
