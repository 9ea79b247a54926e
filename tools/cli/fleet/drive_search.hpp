// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>

#include "manifest.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// Every capture and every folder that holds clouds, at any depth below `root`, as
/// find_recordings() finds them, in order of their names; of a SemanticKITTI sequence the folder
/// above velodyne/. What goes with a drive X is found by its name:
///
///   calibration   of captures: X.calibration.xml, .yaml or .csv beside it; else db.xml, db.yaml,
///                 angle.csv or calibration.xml, .yaml or .csv in its folder, or in the nearest one
///                 above, up to the root, that has one
///   setup         X.setup.yaml, else setup.yaml, in the same way
///   can, dbc      of captures: X.can.log; X.can.dbc, else vehicle.dbc, in the same way
///
/// Errors: kNotFound, there is no drive; kMalformed, where a folder has several calibrations that
/// might be meant, or a CAN recording no DBC file, or the root's path is no UTF-8.
[[nodiscard]] Expected<Manifest> find_drives(const std::filesystem::path& root);

}  // namespace terracut::cli
