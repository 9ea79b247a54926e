// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <functional>

#include "firmware_io/scan/ring_table.hpp"
#include "firmware_io/scan/ring_table_fit.hpp"
#include "rt/error.hpp"

namespace terracut::scan {

/// At most this many scans, evenly spread over the recording, tell a unit's rings.
inline constexpr std::size_t kScansToFit = 40;

/// Calls `read` with the indices of kScansToFit of `scans` scans. What cannot be read is left out:
/// an error only where nothing can, that of one scan, kUnsupported where any was that.
[[nodiscard]] Status read_some_scans(std::size_t scans,
                                     const std::function<Status(std::size_t index)>& read);

/// Adds a scan to `fit`, its rings found with the help of `table` where that is not null. Without
/// it, kUnsupported for a scan that has not all rings.
using AddScan = std::function<Status(std::size_t index, const RingTable* table, RingTableFit& fit)>;

/// Fits a unit's ring table from the scans that have all 64 rings. Where none has, as in cropped
/// views, the rings are told apart by a nominal unit's table first: a row may then be its
/// neighbour's, but its elevation is that of its points.
[[nodiscard]] Expected<FittedRings> fit_rings_of_scans(std::size_t scans, const AddScan& add);

}  // namespace terracut::scan
