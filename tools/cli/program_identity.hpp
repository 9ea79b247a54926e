// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

namespace terracut::cli {

/// A number that two builds of this program share only if they are byte for byte the same: what was
/// computed by one is not taken for the other's. "unknown" where the system does not show a program
/// its own file.
[[nodiscard]] std::string program_identity();

}  // namespace terracut::cli
