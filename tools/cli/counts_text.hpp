// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "rt/named_count.hpp"

namespace terracut::cli {

/// What comes from another process, for a terminal: other than printable ASCII becomes '?'.
[[nodiscard]] std::string printable(std::string_view text);

/// Those that are not 0: "kernel_drops 7, late_frames 2"; empty where all are.
[[nodiscard]] std::string counts_text(std::span<const rt::NamedCount> counts);

}  // namespace terracut::cli
