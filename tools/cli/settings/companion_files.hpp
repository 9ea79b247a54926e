// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>

#include "rt/error.hpp"

namespace terracut::cli {

/// Where to search for the files that belong to a recording: in its folder by its own name,
/// otherwise by a usual name there and in the folders above, up to the root.
struct Beside {
  std::filesystem::path folder, root;
  std::string stem;  ///< The recording's name without its ending.
};

/// Returns the name of a capture or bag without its ending; the whole name if it has neither's.
[[nodiscard]] std::string stem_of(const std::filesystem::path& capture);

/// Returns the setup file of a recording; empty if there is none. Fails with kMalformed if there
/// are two.
[[nodiscard]] Expected<std::filesystem::path> setup_beside(const Beside& recording);
[[nodiscard]] Expected<std::filesystem::path> calibration_beside(const Beside& recording);
/// Returns the calibration in a capture's own folder, which is used if the packets hold none.
[[nodiscard]] Expected<std::filesystem::path> calibration_beside(
    const std::filesystem::path& capture);
/// Returns the metadata of an Ouster in its capture's folder, NAME.calibration.json or NAME.json;
/// empty if there is none. Fails with kMalformed if there are both.
[[nodiscard]] Expected<std::filesystem::path> metadata_beside(const std::filesystem::path& capture);
[[nodiscard]] Expected<std::filesystem::path> can_beside(const Beside& recording);
[[nodiscard]] Expected<std::filesystem::path> dbc_beside(const Beside& recording);

}  // namespace terracut::cli
