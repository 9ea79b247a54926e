// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <filesystem>

#include "manifest.hpp"
#include "rt/error.hpp"

namespace terracut::cli {

/// Returns every capture and every folder with clouds at any depth below `root`, as
/// find_recordings() finds them, in order of names; for a SemanticKITTI sequence, the folder above
/// velodyne/. The files of a drive X are found by name:
///
///   calibration   of captures: X.calibration.xml, .yaml or .csv beside it; else db.xml, db.yaml,
///                 angle.csv or calibration.xml, .yaml or .csv in its folder, or in the nearest one
///                 above, up to the root, that has one
///   setup         X.setup.yaml, else setup.yaml, in the same way
///   can, dbc      of captures: X.can.log; X.can.dbc, else vehicle.dbc, in the same way
///
/// Fails with kNotFound if there is no drive; kMalformed if a folder has several possible
/// calibrations, a CAN recording has no DBC file, or the root's path is not UTF-8.
[[nodiscard]] Expected<Manifest> find_drives(const std::filesystem::path& root);

}  // namespace terracut::cli
