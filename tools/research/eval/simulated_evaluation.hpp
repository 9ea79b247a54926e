// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "calib/mount/mount.hpp"
#include "calib/sensor/sensor_model.hpp"
#include "evaluation.hpp"
#include "journal.hpp"
#include "method_choice.hpp"
#include "rt/error.hpp"

namespace terracut::eval {

/// Drives to simulate, one per scene, with the sensor's nominal calibration, at 10 Hz.
struct SimulatedDrives {
  std::vector<std::string> scenes;  ///< scenes::scene_names(), each once; each is a sequence.
  sensor::SensorModel sensor = sensor::SensorModel::kHdl64e;  ///< encoder_traits.hpp
  bool dual_return = false;
  double duration_s = 3;  ///< (0, 3600]
  std::uint64_t seed = 1;
};

struct SimulatedConfig {
  SimulatedDrives drives;
  FrameRange frames;
  std::vector<MethodChoice> methods;
  mount::Mount mount;       ///< Mount of the simulated sensor.
  bool find_mount = false;  ///< True: uses the mount estimated from the drive's first frames.
  std::filesystem::path predictions;  ///< As EvaluationConfig::predictions: one label per return.
  LabelledByAllSink on_labelled;      ///< As EvaluationConfig::on_labelled.
};

/// Functions called from any thread, one call at a time.
struct SimulatedProgress {
  std::function<void(double, double)> simulated_s;          ///< Seconds done, seconds in all.
  std::function<void(std::size_t, std::size_t)> evaluated;  ///< Frames done, frames in all.
};

/// Simulates each drive, sends it through packets and the decoder, labels every frame with every
/// method and counts against the simulator's truth (SemanticKITTI ids; in dual return both returns
/// count). Otherwise it works as evaluate(): frames in `journal` are not labelled again, and a
/// drive is not simulated if the journal has all of its frames. Range bands are those of the
/// vehicle frame. Frames are labelled one after the other on one pinned core; rays are cast on all
/// cores.
///
/// Fails with kInvalidArgument if the simulator refuses a setting; kMalformed if a mount is not
/// found; kWriteFailed if predictions, journal or the current drive cannot be written. The drive
/// lies in the temporary folder (about 10 MB a second of the HDL-64E, 16 of the RS-Ruby128, up to
/// twice that in dual return).
[[nodiscard]] Expected<EvaluationOutcome> evaluate_simulated(
    const SimulatedConfig& config, Journal* journal, const SimulatedProgress& progress,
    const std::function<bool()>& stop_wanted);

}  // namespace terracut::eval
