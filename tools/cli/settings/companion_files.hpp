// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>
#include <string>

#include "rt/error.hpp"

namespace terracut::cli {

/// Where to look for what goes with a recording: in its folder by its own name, else by a usual
/// name there and in the folders above, up to the root.
struct Beside {
  std::filesystem::path folder, root;
  std::string stem;  ///< Its own name without its ending.
};

/// What stands before the ending of a capture's name; all of it, where that is none of a capture.
[[nodiscard]] std::string stem_of(const std::filesystem::path& capture);

/// The file of that kind; empty: there is none. kMalformed: there are two, either of which might be
/// meant.
[[nodiscard]] Expected<std::filesystem::path> setup_beside(const Beside& recording);
[[nodiscard]] Expected<std::filesystem::path> calibration_beside(const Beside& recording);
/// That of a capture's own folder, which is used where its packets hold none.
[[nodiscard]] Expected<std::filesystem::path> calibration_beside(
    const std::filesystem::path& capture);
[[nodiscard]] Expected<std::filesystem::path> can_beside(const Beside& recording);
[[nodiscard]] Expected<std::filesystem::path> dbc_beside(const Beside& recording);

}  // namespace terracut::cli
