// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <functional>

#include "firmware_io/scan/ring_table.hpp"
#include "firmware_io/scan/ring_table_fit.hpp"
#include "rt/error.hpp"

namespace terracut::scan {

/// A unit's rings are found from at most this many scans, evenly spread over the recording.
inline constexpr std::size_t kScansToFit = 40;

/// Calls `read` with kScansToFit indices out of `scans`. Scans that cannot be read are left out. If
/// none can be read, returns the error of one scan, preferably kUnsupported.
[[nodiscard]] Status read_some_scans(std::size_t scans,
                                     const std::function<Status(std::size_t index)>& read);

/// Adds a scan to `fit`, finding its rings with the help of `table`. Without a table (null), fails
/// with kUnsupported for a scan that does not have all rings.
using AddScan = std::function<Status(std::size_t index, const RingTable* table, RingTableFit& fit)>;

/// Fits a unit's ring table to the scans that have all 64 rings. If none has, as in cropped views,
/// a nominal unit's table first tells the rings apart: a row may then be numbered as its neighbour,
/// but its elevation is that of its points.
[[nodiscard]] Expected<FittedRings> fit_rings_of_scans(std::size_t scans, const AddScan& add);

}  // namespace terracut::scan
