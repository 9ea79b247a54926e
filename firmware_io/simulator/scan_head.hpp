// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "calib/hdl64e_geometry.hpp"
#include "firmware_io/hdl64e/firing_azimuth.hpp"
#include "firmware_io/simulator/drive.hpp"
#include "firmware_io/simulator/firing_plan.hpp"
#include "firmware_io/simulator/object_index.hpp"
#include "firmware_io/simulator/terrain.hpp"

namespace terracut::firmware_io {

/// The world as one beam finds it.
struct Moment {
  const ObjectIndex* objects = nullptr;
  double after_s = 0;  ///< Time since the objects' update().
  Eigen::Isometry3d T_world_lidar = Eigen::Isometry3d::Identity();
};

/// The sensor: casts the 64 beams of a firing and writes down what they measure, in the units of
/// the wire and through the inverse of the unit's calibration.
///
/// Immutable; any thread may cast.
class ScanHead {
 public:
  /// All three must outlive this.
  ScanHead(const SimulationConfig& config, const Terrain& terrain, const FiringPlan& plan);

  /// `moments` by turn of the beam, even and odd: they differ when the world stands still during
  /// each turn. Fills in everything of `column`.
  void cast(const Firing& firing, const std::array<Moment, 2>& moments,
            SimulatedColumn& column) const;

 private:
  void measure(int laser, std::uint64_t ray_key, double azimuth_rad, const Moment& moment,
               LabelledReturn& wire, calib::Point& exact) const;

  const SimulationConfig* config_;
  const Terrain* terrain_;
  const FiringPlan* plan_;
  calib::Hdl64eGeometry geometry_;
  BeamOffsets offsets_;
};

}  // namespace terracut::firmware_io
