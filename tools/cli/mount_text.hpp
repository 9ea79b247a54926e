// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "rt/mount_figures.hpp"

namespace terracut::cli {

/// One line, for people, with what mends it; empty where nothing is contradicted.
[[nodiscard]] std::string contradiction_text(const rt::MountFigures& mount);

/// height_m, roll_deg, pitch_deg (given), turns, contradicted; where it is, seen{the same three}.
[[nodiscard]] nlohmann::ordered_json mount_json(const rt::MountFigures& mount);

}  // namespace terracut::cli
