// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <string>

#include "pipeline/status/monitor_snapshot.hpp"

namespace terracut::cli {

/// Returns the figures in Prometheus' text exposition format 0.0.4. Every counter counts since the
/// start of the process; times are seconds. A value up to 1/128 below a bucket's limit may be
/// counted in the next bucket, but a value above the limit never in this one
/// (measure::LogLinearHistogram::count_not_above).
[[nodiscard]] std::string metrics_text(const status::MonitorSnapshot& figures);

}  // namespace terracut::cli
