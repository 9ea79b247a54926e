// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "firmware_io/capture/capture_source.hpp"
#include "tools/cli/options.hpp"

namespace terracut::cli {

/// Returns the filter that --from, --port, --to, --vlan and --mac describe.
[[nodiscard]] capture::CaptureFilter filter_of(const CaptureOptions& options);

}  // namespace terracut::cli
