// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include "tools/lab/encode/hdl64e_encoder_traits.hpp"
#include "tools/lab/encode/ruby128_encoder_traits.hpp"

/// An `EncoderTraits` is a trait: all that makers of packets (DriveWriter, the simulator,
/// ScanResampler) need to know of a sensor, the counterpart of a decoder's `Sensor`. Those
/// templates are instantiated for the two that this header brings in. It has
/// - `Calibration`, `Geometry`, `Offsets` (of the beams), `Config` with `returns`, and `Column`, a
///   LabelledColumn of its `kLasers`;
/// - `kColumnsPerPacket`; `firings_per_group(returns)`, the fewest that fill whole packets, which
///   share a firing where they are several; `firing_ns(returns)`, from firing to firing;
/// - `step_ticks(rotor_cdeg, place, returns)`: the step by which the decoder computes the beams of
///   the firing at `place` of a group, given the group's azimuths, each in [0, 36000);
/// - `advance_ticks(step_ticks, laser, returns)`, `offset_ticks(offsets, step_ticks, laser,
///   returns)`: the head's and the beam's azimuth at the laser's firing over its column's;
/// - `offsets(calibration)`, `geometry(calibration, config)`, `nominal()`,
///   `metres_per_count(calibration)`, `widest_offset_rad(calibration)`;
/// - `kStrongestFirst`: the order of two returns; `kBeamHalfWidth_rad`: of the light;
/// - `kCalibrationSuffix`, `read_calibration(path)`, `write_calibration(path, calibration)`: the
///   unit's table as a file;
/// - `sender(calibration, config)`: a `Sender`, which makes the packets and puts them into a
/// capture
///   (hdl64e/packet_sender.hpp).
