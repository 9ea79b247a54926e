// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>

#include "pipeline/status/figure.hpp"
#include "pipeline/status/monitor_snapshot.hpp"

namespace terracut::cli {

/// Adds each figure to `json`, in its group under its key. Durations are milliseconds, times of day
/// nanoseconds, histograms {count, mean, p50, p90, p99, p99.9, max} of milliseconds.
void add_figures(std::span<const status::Figure> figures, nlohmann::ordered_json& json);

/// Returns all figures of a live run for programs, as `terracut top --print-json` prints them and a
/// run writes them at its end: those of status::figures_of(), under their keys. `motion` and
/// `health` are present if used; `blind` is null if no blind sector is known.
[[nodiscard]] nlohmann::ordered_json live_summary(const status::MonitorSnapshot& figures);

}  // namespace terracut::cli
